//! Verdicts as JUnit XML.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{Judgement, Reproduction, Verdict};

/// The JUnit document: a suite of gates and one of reproduced constants.
///
/// A gate that was not measured is a skipped case; a warning is a success with the warning in its
/// output.
pub fn junit(judgements: &[Judgement], reproductions: &[Reproduction]) -> String {
    let mut gates = TestSuite::new("gates");
    for judgement in judgements {
        let gate = &judgement.gate;
        let domain = gate.domain.as_ref().map_or(String::new(), |domain| format!(" {domain}"));
        let name = format!("{} {} {}{domain}", gate.subject, gate.metric, gate.precision);
        gates.add_test_case(case(&name, judgement.verdict, &judgement.summary(), &gate.why));
    }
    let mut constants = TestSuite::new("constants reproduce");
    for reproduction in reproductions {
        let Reproduction { fit, verdict, detail, .. } = reproduction;
        let why = "a refit gives the committed constants";
        constants.add_test_case(case(fit, *verdict, detail, why));
    }
    let mut report = Report::new("striae check");
    report.add_test_suites([gates, constants]);
    // Every string has passed through XmlString, which drops what XML cannot hold; writing to
    // memory cannot fail otherwise.
    report.to_string().unwrap_or_default()
}

fn case(name: &str, verdict: Verdict, summary: &str, why: &str) -> TestCase {
    let mut status = match verdict {
        Verdict::Pass | Verdict::Warn => TestCaseStatus::success(),
        Verdict::NotMeasured => TestCaseStatus::skipped(),
        Verdict::Fail => TestCaseStatus::non_success(NonSuccessKind::Failure),
    };
    if verdict >= Verdict::NotMeasured {
        status.set_message(summary);
        status.set_description(why);
    }
    let mut case = TestCase::new(name, status);
    case.set_classname("striae");
    case.set_system_out(format!("{}: {summary}\n{why}", verdict.word()));
    case
}
