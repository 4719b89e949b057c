//! Reports: how a document is drawn and written as HTML.
//!
//! [`crate::document`] says what a page holds, [`plot`] draws its figures, [`html::write_site`]
//! writes pages, JSON and plain text into one folder.

pub mod html;
pub mod pages;
pub mod plot;
