//! Image files, FLIP against its authors' evaluator, the noise test, and the verb `compare`.

mod files;
mod flip;
mod noise;
mod verb;
