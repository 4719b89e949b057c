//! Reports: a document model, and what it is written as (HTML, JSON, plain text, SVG).
//!
//! [`document`] says what a page holds, [`plot`] draws its figures, [`html`], [`json`] and [`text`]
//! write it. [`html::write_site`] writes all of them into one folder.

mod document_inline;
pub mod document_cell;
mod document_table;
pub mod document;
pub mod plot;
pub mod json;
pub mod text;
pub mod html;
pub mod pages;
