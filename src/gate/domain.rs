//! Over which points a gate measures.

use std::fmt;

use crate::validate::sampling::{self, DomainSyntax};

/// Points that a gate asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Domain {
    /// `x = -10:10; y = 0:1`: an interval per argument.
    Box(sampling::ArgumentBox),
    /// `far`: a region that the effect names.
    Region(String),
}

impl Domain {
    /// Reads `x = -10:10; y = 0:1`, or the name of a region, which contains no `=`.
    ///
    /// # Errors
    /// [`DomainSyntax`] for anything else.
    pub fn parse(text: &str) -> Result<Self, DomainSyntax> {
        if text.trim().is_empty() || text.contains('=') {
            sampling::ArgumentBox::parse(text).map(Self::Box)
        } else {
            Ok(Self::Region(text.trim().to_owned()))
        }
    }
}

impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Region(name) => f.write_str(name),
            Self::Box(domain) => {
                let shown =
                    |of: &sampling::Interval| format!("{} = {}:{}", of.argument, of.from, of.to);
                let intervals: Vec<String> = domain.intervals.iter().map(shown).collect();
                f.write_str(&intervals.join("; "))
            }
        }
    }
}

impl serde::Serialize for Domain {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_domain_reads_back_as_it_prints() {
        for text in ["x = -10:10", "mu = 0:1; eta = 1.2:3", "far", "[-10, 10]"] {
            let domain = Domain::parse(text).expect(text);
            assert_eq!(domain.to_string(), text);
        }
    }

    #[test]
    fn what_holds_no_points_is_refused() {
        for text in ["", " ", "x = 1:1", "x = 2:1", "x =", "= 0:1", "x = 0:inf", "x = a:1"] {
            assert!(Domain::parse(text).is_err(), "{text}");
        }
    }
}
