//! Why a form could not be loaded, evaluated or emitted.

/// What went wrong with a form. Every message names the file, and the line where there is one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FormError {
    /// The text does not parse or validate; `report` shows file, line and a caret.
    #[error("{report}")]
    Invalid {
        /// Rendered diagnostic.
        report: String,
    },
    /// A construct that forms cannot use, named with its place.
    #[error("{origin}:{line}: {what} is not supported in a form")]
    Unsupported {
        /// File the text came from.
        origin: String,
        /// Line, from 1.
        line: usize,
        /// The construct.
        what: String,
    },
    /// A table given beside the text is not what the text declares.
    #[error("{origin}: table `{table}` {what}")]
    Table {
        /// File the text came from.
        origin: String,
        /// Name of the table.
        table: String,
        /// What is wrong.
        what: String,
    },
    /// The text has no function of that name.
    #[error("{origin}: no function `{function}`; the functions here are: {available}")]
    NoFunction {
        /// File the text came from.
        origin: String,
        /// The name asked for.
        function: String,
        /// The names that there are, separated by commas.
        available: String,
    },
    /// The text, its nesting or its compiled program exceeds a stated limit.
    #[error("{origin}:{line}: {what}")]
    TooLarge {
        /// File the text came from.
        origin: String,
        /// Line, from 1.
        line: usize,
        /// The limit and what exceeded it.
        what: String,
    },
    /// A number of parameters, inputs or free indices that does not fit the form.
    #[error("{origin}: function `{function}`: {what}")]
    Shape {
        /// File the text came from.
        origin: String,
        /// The function.
        function: String,
        /// Expected and got.
        what: String,
    },
    /// A number that an integer argument does not take exactly.
    #[error(
        "{origin}: function `{function}`: argument `{argument}`, row {row}: expected {expected}, got {got}"
    )]
    Input {
        /// File the text came from.
        origin: String,
        /// The function.
        function: String,
        /// The argument, with its component if it is a vector.
        argument: String,
        /// Row of the column, from 0.
        row: usize,
        /// What the argument takes.
        expected: &'static str,
        /// The number.
        got: f64,
    },
    /// A loop that did not end for every lane within the stated bound.
    #[error("{origin}:{line}: this loop did not end within {limit}")]
    Unbounded {
        /// File the text came from.
        origin: String,
        /// Line of the loop, from 1.
        line: usize,
        /// The bound that was reached.
        limit: String,
    },
    /// A back end could not write the form, or a value to bake in is missing or unusable.
    #[error("{origin}: emitting `{function}` as {language}: {what}")]
    Emit {
        /// File the text came from.
        origin: String,
        /// The function.
        function: String,
        /// The target language.
        language: String,
        /// What the writer said.
        what: String,
    },
}
