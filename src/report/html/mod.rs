//! The report as HTML: one self-contained page per [`Page`](crate::document::Page), no network,
//! no other files needed to read it.

mod blocks;
mod shell;
mod site;
mod tables;

pub use shell::{PageFiles, render_page};
pub use site::{SiteError, Written, write_site};
