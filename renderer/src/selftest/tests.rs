//! Synchronisation left out on purpose: the self-test must say so, and name the check that tells.

use super::*;
use crate::pass::Faults;
use std::sync::atomic::AtomicBool;

fn outcomes(faults: Faults, check: &str, validate: bool) -> SelfTest {
    let options = Options { checks: vec![check.to_owned()], validate, ..Options::default() };
    let mut context = Context::with_faults(options, faults).unwrap();
    let watch = Watch { interrupt: &AtomicBool::new(false), progress: &|| {} };
    self_test(&mut context, &watch, &|_| {}).unwrap()
}

#[test]
fn a_timestamp_without_its_barrier_is_noticed() {
    let faults = Faults { loose_timestamps: true, ..Faults::default() };
    let found = outcomes(faults, "timestamps", false);
    assert_eq!(found.faults(), ["timestamps"], "{found}");
}

/// Lavapipe does one thing after the other whatever waits for what, so that there the validation layers alone can tell.
#[test]
fn passes_that_wait_for_nothing_are_noticed() {
    let faults = Faults { unsynchronised_passes: true, ..Faults::default() };
    let found = outcomes(faults, "counters", true);
    assert_eq!(found.faults(), ["counters"], "{found}");
    assert!(found.to_string().contains("SYNC-HAZARD"), "{found}");
}

#[test]
fn what_is_wrong_is_told_with_what_it_means() {
    let outcome = |verdict| Outcome::new("lists", "lists are void", verdict, 0.5);
    let device = crate::vk::DeviceInfo {
        name: "a device".into(),
        driver: "a driver".into(),
        driver_version: "1".into(),
        api_version: "1.3.0".into(),
        hardware: crate::machine::Device::default(),
    };
    let found = SelfTest {
        device,
        checks: vec![
            outcome(Verdict::Fine("7 lists".into())),
            outcome(Verdict::Wrong("list 3\nis short".into())),
        ],
    };
    assert_eq!(
        found.to_string(),
        "ok     lists       7 lists\nwrong  lists       list 3 is short (lists are void)\n\
         a device, a driver 1: is not fit to be measured, 2 checks in 1 s"
    );
    assert_eq!(found.faults(), ["lists"]);
}

#[test]
fn a_check_that_is_misspelt_is_named() {
    let options = Options { checks: vec!["golde".into()], ..Options::default() };
    let error = check_count(&options).unwrap_err().to_string();
    assert!(error.contains("golde") && error.contains("golden"), "{error}");
    assert_eq!(check_count(&Options::default()).unwrap(), CHECKS.len());
}
