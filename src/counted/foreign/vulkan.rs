//! Vulkan's compute pipelines, compiled and never run, with what the driver says of them
//! (`VK_KHR_pipeline_executable_properties`).

use std::ffi::{CStr, c_char};

use ash::khr::pipeline_executable_properties as executable_properties;
use ash::vk;

use crate::counted::statistics::Compiled;
use crate::form::TABLE_GROUP;

/// A device of the driver that the loader finds, without anything but pipelines in it.
///
/// It and what it owns live as long as the child process, which ends by itself: nothing is destroyed, and
/// so nothing can be used after it is.
pub(in crate::counted) struct Compiler {
    device: ash::Device,
    executables: executable_properties::Device,
    _entry: ash::Entry,
    _instance: ash::Instance,
    driver: String,
}

fn failed(what: &str) -> impl Fn(vk::Result) -> String {
    move |result| format!("{what}: {result}")
}

impl Compiler {
    /// Opens the first device of the loader.
    pub(in crate::counted) fn open() -> Result<Self, String> {
        // SAFETY: the loader is the system's Vulkan library; its initialisers are what the system trusts.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| format!("no Vulkan: {error}"))?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_2);
        let info = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: `info` is complete and lives through the call; it asks for no layer and no extension.
        let instance =
            unsafe { entry.create_instance(&info, None) }.map_err(failed("no Vulkan instance"))?;
        // SAFETY: the instance was just made and is never destroyed.
        let found = unsafe { instance.enumerate_physical_devices() };
        let found = found.map_err(failed("no Vulkan device"))?;
        let physical = *found.first().ok_or("the driver shows no device")?;
        let mut vulkan12 = vk::PhysicalDeviceDriverProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut vulkan12);
        // SAFETY: `physical` is of this instance; the chain is of structures that Vulkan 1.2 knows.
        unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
        let name = text(&properties.properties.device_name);
        let driver = format!("{name}, {}", text(&vulkan12.driver_info));

        let mut feature = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
            .pipeline_executable_info(true);
        let queues =
            [vk::DeviceQueueCreateInfo::default().queue_family_index(0).queue_priorities(&[1.0])];
        let extensions = [executable_properties::NAME.as_ptr()];
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&extensions)
            .push_next(&mut feature);
        // SAFETY: everything that `info` points to lives through the call; a family or an extension that
        // the device has not is refused by the driver with an error.
        let device = unsafe { instance.create_device(physical, &info, None) }
            .map_err(failed("no device with VK_KHR_pipeline_executable_properties"))?;
        let executables = executable_properties::Device::new(&instance, &device);
        Ok(Self { device, executables, _entry: entry, _instance: instance, driver })
    }

    /// Name of the device and version of the driver.
    pub(in crate::counted) fn driver(&self) -> &str {
        &self.driver
    }

    /// Compiles the entry point `main` of SPIR-V that writes a buffer at group 0, binding 0, and reads
    /// `tables` buffers in the group of tables.
    ///
    /// `words` must be valid SPIR-V, which naga writes from a module that it has validated.
    pub(in crate::counted) fn compile(
        &self,
        words: &[u32],
        tables: u32,
    ) -> Result<Compiled, String> {
        let device = &self.device;
        let module = vk::ShaderModuleCreateInfo::default().code(words);
        // SAFETY: `words` is valid SPIR-V, as this function asks.
        let module = unsafe { device.create_shader_module(&module, None) }
            .map_err(failed("the module is refused"))?;
        let groups = (0..=TABLE_GROUP).map(|group| if group == 0 { 1 } else { tables });
        let groups = groups.map(|count| self.group_layout(count)).collect::<Result<Vec<_>, _>>()?;
        let layout = vk::PipelineLayoutCreateInfo::default().set_layouts(&groups);
        // SAFETY: the layouts were just made on this device.
        let layout = unsafe { device.create_pipeline_layout(&layout, None) }
            .map_err(failed("no pipeline layout"))?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(c"main");
        let info = vk::ComputePipelineCreateInfo::default()
            .flags(
                vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR
                    | vk::PipelineCreateFlags::CAPTURE_INTERNAL_REPRESENTATIONS_KHR,
            )
            .stage(stage)
            .layout(layout);
        // SAFETY: module and layout are of this device, and the feature behind the flags is enabled.
        let made =
            unsafe { device.create_compute_pipelines(vk::PipelineCache::null(), &[info], None) };
        let made = made.map_err(|(_, result)| format!("the pipeline is refused: {result}"))?;
        let pipeline = *made.first().ok_or("the driver returned no pipeline")?;
        let executable = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline);
        // SAFETY: the pipeline is alive, was made with the flag of statistics, and has an executable 0.
        let rows = unsafe { self.executables.get_pipeline_executable_statistics(&executable) };
        let rows = rows.map_err(failed("no statistics"))?;
        let statistics = rows.iter().map(|row| (text(&row.name), value(row))).collect();
        let assembly = self.assembly(&executable)?;
        // SAFETY: both were made here, and nothing that is in use refers to them.
        unsafe {
            device.destroy_pipeline(pipeline, None);
            device.destroy_shader_module(module, None);
        }
        Ok(Compiled { statistics, assembly })
    }

    fn group_layout(&self, buffers: u32) -> Result<vk::DescriptorSetLayout, String> {
        let binding = |binding| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)
        };
        let bindings: Vec<_> = (0..buffers).map(binding).collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: `info` and the bindings live through the call.
        unsafe { self.device.create_descriptor_set_layout(&info, None) }
            .map_err(failed("no group layout"))
    }

    /// The text of the machine code.
    fn assembly(&self, executable: &vk::PipelineExecutableInfoKHR<'_>) -> Result<String, String> {
        let representations = |of: &mut [vk::PipelineExecutableInternalRepresentationKHR<'_>]| {
            let mut count = of.len() as u32;
            let call = self.executables.fp().get_pipeline_executable_internal_representations_khr;
            let place = if of.is_empty() { std::ptr::null_mut() } else { of.as_mut_ptr() };
            // SAFETY: the pipeline is alive and was made with the flag of representations; `count` says
            // how many `place` holds, and the data of each is null or a buffer of `data_size` bytes.
            let result = unsafe { call(self.device.handle(), executable, &mut count, place) };
            match result {
                vk::Result::SUCCESS => Ok(count as usize),
                other => Err(failed("no machine code")(other)),
            }
        };
        // Three calls, as the interface wants: how many there are, how long they are, the bytes.
        let mut found = vec![Default::default(); representations(&mut [])?];
        if found.is_empty() {
            return Err("the driver shows no machine code".to_owned());
        }
        representations(&mut found)?;
        let mut texts: Vec<Vec<u8>> = found.iter().map(|of| vec![0; of.data_size]).collect();
        for (of, text) in found.iter_mut().zip(&mut texts) {
            of.p_data = text.as_mut_ptr().cast();
        }
        representations(&mut found)?;
        let named = found.iter().position(|of| text(&of.name).contains("Assembly"));
        let at = named.ok_or("the driver shows no disassembly")?;
        let bytes = texts[at].split(|byte| *byte == 0).next().unwrap_or_default();
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }
}

fn value(row: &vk::PipelineExecutableStatisticKHR<'_>) -> f64 {
    // SAFETY: `format` says which member of the union the driver wrote.
    unsafe {
        match row.format {
            vk::PipelineExecutableStatisticFormatKHR::UINT64 => row.value.u64 as f64,
            vk::PipelineExecutableStatisticFormatKHR::INT64 => row.value.i64 as f64,
            vk::PipelineExecutableStatisticFormatKHR::FLOAT64 => row.value.f64,
            _ => f64::from(row.value.b32),
        }
    }
}

fn text(name: &[c_char]) -> String {
    let bytes: Vec<u8> = name.iter().map(|c| *c as u8).collect();
    CStr::from_bytes_until_nul(&bytes).map_or_else(
        |_| String::from_utf8_lossy(&bytes).into_owned(),
        |text| text.to_string_lossy().into_owned(),
    )
}
