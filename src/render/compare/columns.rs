//! Errors of tables, column by column.

use super::CompareError;
use super::metrics::Difference;
use crate::table::Table;

/// How a column differs from the same column of a reference.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnDifference {
    /// Name of the column.
    pub name: String,
    /// Unit of the reference, in which the errors are.
    pub unit: String,
    /// The errors; places are rows, from 0.
    pub difference: Difference,
}

/// Compares tables that have the same columns, in any order and in units that convert.
///
/// # Errors
/// [`CompareError::Unusable`] or [`CompareError::Rows`] if they do not match,
/// [`CompareError::Table`] if a unit does not convert.
pub fn column_differences(
    test: &Table,
    reference: &Table,
) -> Result<Vec<ColumnDifference>, CompareError> {
    let missing = |from: &Table, of: &Table| {
        let names = of.names().into_iter().filter(|name| from.column(name).is_none());
        Some(names.collect::<Vec<_>>().join(", ")).filter(|names| !names.is_empty())
    };
    let (in_test, in_reference) = (missing(test, reference), missing(reference, test));
    if in_test.is_some() || in_reference.is_some() {
        let [test, reference] = [in_test, in_reference].map(|of| of.unwrap_or("none".into()));
        return Err(CompareError::Unusable(format!(
            "columns differ: not in the test table: {test}; not in the reference: {reference}"
        )));
    }
    if test.rows() != reference.rows() {
        return Err(CompareError::Rows { test: test.rows(), reference: reference.rows() });
    }
    let of = |column: &crate::table::Column| {
        let tested = test.values_in(&column.name, &column.unit)?;
        let difference = Difference::of(tested.into_iter().zip(column.values.iter().copied()))
            .ok_or(CompareError::Rows { test: 0, reference: 0 })?;
        Ok(ColumnDifference { name: column.name.clone(), unit: column.unit.clone(), difference })
    };
    reference.columns.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        Table::read_csv_str("text", text).expect("a table")
    }

    #[test]
    fn units_convert_and_order_does_not_matter() {
        let test = table("y,x [nm]\n2,1000\n4,3000\n");
        let reference = table("x [um],y\n1,2\n2,5\n");
        let columns = column_differences(&test, &reference).expect("the same columns");
        let x = columns[0].difference;
        assert!((x.max - 1.0).abs() < 1e-14 && x.max_at == 1, "{x:?}");
        assert_eq!((columns[1].name.as_str(), columns[1].difference.max), ("y", 1.0));
    }

    #[test]
    fn what_does_not_match_is_named() {
        let refused = column_differences(&table("x,y\n1,2\n"), &table("x,z\n1,2\n"));
        let message = refused.expect_err("other columns").to_string();
        assert!(message.contains("y") && message.contains("z"), "{message}");
        let refused = column_differences(&table("x\n1\n"), &table("x\n1\n2\n"));
        assert!(matches!(refused, Err(CompareError::Rows { test: 1, reference: 2 })));
    }
}
