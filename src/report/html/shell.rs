//! A page: head, contents, sections, provenance.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::blocks::{block, inline};
use crate::document::{Colophon, Page};
use crate::report::plot::{Drawing, dark_rules};

/// The style sheet of every page.
const STYLE: &str = include_str!("page.css");

/// A page, written, with the figures that it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct PageFiles {
    /// The whole HTML document.
    pub html: String,
    /// File stem and drawing of every figure, in order.
    pub drawings: Vec<(String, Drawing)>,
}

/// Writes one page. `pages` are all pages of the report, for the links between them; the page with
/// the slug `index` lists the others with their summaries.
pub fn render_page(page: &Page, pages: &[Page], provenance: &Colophon) -> PageFiles {
    let mut drawings = Vec::new();
    let mut sections = Vec::new();
    for (index, section) in page.sections.iter().enumerate() {
        let blocks: Vec<Markup> = section.blocks.iter().map(|b| block(b, &mut drawings)).collect();
        sections.push((anchor(index, &section.title), section.title.as_str(), blocks));
    }
    // On screens only: paper is white.
    let dark = "@media screen and (prefers-color-scheme:dark)";
    let dark_plots = format!("{dark}{{{}}}\n", dark_rules());
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content={ "striae " (provenance.version) };
                title { (page.title) " · striae" }
                style { (PreEscaped(STYLE)) (PreEscaped(dark_plots)) }
            }
            body {
                a.skip href="#content" { "Skip to the content" }
                header.site {
                    a.project href="index.html" { "striae" }
                    (links(page, pages))
                }
                div.columns {
                    (contents(&sections))
                    main id="content" {
                        h1 { (page.title) }
                        p.summary { (inline(&page.summary)) }
                        @if page.slug == "index" { (list(pages)) }
                        @for (id, title, blocks) in &sections {
                            section id=(id) aria-labelledby={ (id) "-title" } {
                                h2 id={ (id) "-title" } { (title) }
                                @for one in blocks { (one) }
                            }
                        }
                    }
                }
                footer {
                    dl {
                        @for (name, value) in provenance.lines() {
                            div { dt { (name) } dd {
                                @if name == "command" { code { (value) } } @else { (value) }
                            } }
                        }
                    }
                }
            }
        }
    };
    PageFiles { html: markup.into_string() + "\n", drawings }
}

/// Links between the pages.
fn links(page: &Page, pages: &[Page]) -> Markup {
    html! {
        nav.pages aria-label="Pages" {
            @for other in pages {
                a href={ (other.slug) ".html" }
                    aria-current=[(other.slug == page.slug).then_some("page")] { (other.title) }
            }
        }
    }
}

/// The sections of this page.
fn contents(sections: &[(String, &str, Vec<Markup>)]) -> Markup {
    html! {
        nav.contents aria-label="On this page" {
            @if !sections.is_empty() {
                h2 { "On this page" }
                ol { @for (id, title, _) in sections { li { a href={ "#" (id) } { (title) } } } }
            }
        }
    }
}

/// The other pages, with their summaries.
fn list(pages: &[Page]) -> Markup {
    html! {
        ul.cards {
            @for page in pages.iter().filter(|p| p.slug != "index") {
                li {
                    a href={ (page.slug) ".html" } { (page.title) }
                    p { (inline(&page.summary)) }
                }
            }
        }
    }
}

/// An identifier: readable, and unique by its number.
fn anchor(index: usize, title: &str) -> String {
    let words: Vec<String> = title
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|w| !w.is_empty())
        .map(str::to_ascii_lowercase)
        .collect();
    format!("s{}-{}", index + 1, words.join("-"))
}
