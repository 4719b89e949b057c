//! Blocks of a section as HTML.

use maud::{Markup, PreEscaped, html};

use super::tables::{table, unfolded};
use crate::document::{Block, Figure, Inline, Raster, Span};
use crate::report::plot::{Drawing, draw};

/// Text with its markup.
pub(super) fn inline(text: &Inline) -> Markup {
    html! {
        @for span in text.spans() {
            @match span {
                Span::Plain(text) => (text),
                Span::Code(text) => code { (text) },
                Span::Link { text, href } => a href=(safe(href)) { (text) },
            }
        }
    }
}

/// `href`, unless it would run a script.
pub(super) fn safe(href: &str) -> &str {
    let scheme = href.split_once(':').map(|(scheme, _)| scheme.trim().to_ascii_lowercase());
    match scheme.as_deref() {
        None | Some("http" | "https" | "mailto") => href,
        // A colon after a slash or in a fragment is part of a path.
        Some(scheme) if scheme.contains(['/', '#', '?', '.']) => href,
        Some(_) => "#",
    }
}

/// A block; the drawings of its figures are added to `drawings`.
pub(super) fn block(block: &Block, drawings: &mut Vec<(String, Drawing)>) -> Markup {
    match block {
        Block::Paragraph(text) => html! { p { (inline(text)) } },
        Block::List(items) => html! { ul { @for item in items { li { (inline(item)) } } } },
        Block::Table(one) => table(one),
        Block::Figure(one) => figure(one, drawings),
        Block::Picture(one) => picture(one),
        Block::Notice { level, text } => html! {
            p class={ "notice " (level.word().replace(' ', "-")) } role="note" {
                strong { (level.word()) } " " (inline(text))
            }
        },
        Block::Details { summary, blocks } => {
            // What was asked for is not folded again.
            let inner = blocks.iter().map(|inner| match inner {
                Block::Table(table) => unfolded(table, true),
                other => self::block(other, drawings),
            });
            let inner: Vec<Markup> = inner.collect();
            html! { details { summary { (inline(summary)) } @for one in &inner { (one) } } }
        }
    }
}

fn figure(figure: &Figure, drawings: &mut Vec<(String, Drawing)>) -> Markup {
    let drawing = draw(figure);
    let markup = html! {
        figure id=(figure.file_stem) {
            div.scroll tabindex="0" role="region" aria-label={ "figure " (figure.file_stem) } {
                (PreEscaped(&drawing.svg))
            }
            figcaption {
                (inline(&figure.caption))
                @for note in &drawing.notes { " " span.note { (note) } }
                " " a.file href={ "figures/" (figure.file_stem) ".svg" } { "SVG" }
            }
        }
    };
    drawings.push((figure.file_stem.clone(), drawing));
    markup
}

fn picture(picture: &Raster) -> Markup {
    let file = format!("figures/{}.png", picture.file_stem);
    html! {
        figure id=(picture.file_stem) {
            div.scroll tabindex="0" role="region" aria-label={ "picture " (picture.file_stem) } {
                img src=(file) alt=(picture.alt);
            }
            figcaption { (inline(&picture.caption)) " " a.file href=(file) { "PNG" } }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::safe;

    #[test]
    fn scripts_are_no_links() {
        assert_eq!(safe("javascript:alert(1)"), "#");
        assert_eq!(safe(" JavaScript:alert(1)"), "#");
        assert_eq!(safe("data:text/html,x"), "#");
        for plain in ["https://doi.org/10.1/x", "fresnel.html#a", "a/b:c", "#x:y"] {
            assert_eq!(safe(plain), plain);
        }
    }
}
