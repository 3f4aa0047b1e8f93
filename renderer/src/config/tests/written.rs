//! How values are written and read.

use super::*;
use proptest::prelude::*;

#[test]
fn frame_ranges_are_read_as_documented() {
    let range = |first, end, step| Ok(FrameRange { first, end, step });
    assert_eq!("300..600/40".parse(), range(300, Some(600), 40));
    assert_eq!("300..600".parse(), range(300, Some(600), 1));
    assert_eq!("300..".parse(), range(300, None, 1));
    assert_eq!("..600".parse(), range(0, Some(600), 1));
    assert_eq!("..".parse(), range(0, None, 1));
    assert_eq!("580".parse(), range(580, Some(581), 1));
    assert_eq!("/40".parse(), range(0, None, 40));
    for wrong in [
        "",
        "a",
        "..b",
        "1..2..3",
        "5/2",
        "4294967295",
        "4294967296",
        "1../",
        "-1..",
        "3..2",
        "2..2",
        "/0",
        "1 .. 2",
    ] {
        assert!(wrong.parse::<FrameRange>().is_err(), "{wrong}");
    }
}

#[test]
fn frame_ranges_leave_the_end_out_and_stay_within_the_recording() {
    let range = |text: &str| text.parse::<FrameRange>().unwrap();
    assert_eq!(range("300..600/100").frames(670).unwrap(), [300, 400, 500]);
    assert_eq!(range("/300").frames(601).unwrap(), [0, 300, 600]);
    assert_eq!(range("668..670").frames(670).unwrap(), [668, 669]);
    for (text, available) in [("668..671", 670), ("670..", 670), ("..", 0)] {
        assert!(range(text).frames(available).unwrap_err().to_string().contains("recording"), "{text}");
    }
}

#[test]
fn lightings_are_read_as_documented() {
    assert_eq!("1000".parse(), Ok(Lighting::with_count(1000)));
    assert_eq!("10000,20".parse(), Ok(Lighting { intensity: 20.0, ..Lighting::with_count(10_000) }));
    assert_eq!("5, 1, 0.25, 0.5".parse(), Ok(Lighting { count: 5, intensity: 1.0, cutoff: 0.25, r0: 0.5 }));
    for wrong in [
        "",
        "0",
        "-1",
        "1.5",
        "1,0",
        "1,nan",
        "1,inf",
        "1,1,-1",
        "1,1,1,1",
        "1,1,1,0",
        "1,100,0.5,0.1,9",
        "1,",
    ] {
        assert!(wrong.parse::<Lighting>().is_err(), "{wrong}");
    }
}

#[test]
fn resolutions_and_samples_are_read_as_documented() {
    assert_eq!(values::resolution("1280x720"), Ok([1280, 720]));
    for wrong in ["", "1280", "0x1", "1x0", "16385x1", "1x2x3", "axb", "1280X720"] {
        assert!(values::resolution(wrong).is_err(), "{wrong}");
    }
    assert_eq!((values::msaa("1"), values::msaa("4")), (Ok(1), Ok(4)));
    assert!(values::msaa("2").is_err() && values::msaa("x").is_err());
}

proptest! {
    #[test]
    fn frame_ranges_survive_being_written(first in 0..u32::MAX, length in 1..u32::MAX, step in 1..u32::MAX, open: bool) {
        let range = FrameRange { first, end: (!open).then(|| first.saturating_add(length)), step };
        prop_assert_eq!(range.to_string().parse(), Ok(range));
    }

    #[test]
    fn lightings_survive_being_written(count in 1..u32::MAX, cutoff in 1e-3_f32..1.0, r0 in 1e-3_f32..1.0) {
        let lighting = Lighting { count, intensity: 4.0, cutoff, r0 };
        prop_assert_eq!(lighting.to_string().parse(), Ok(lighting));
    }

    #[test]
    fn no_text_makes_the_parsers_panic(text in "\\PC*") {
        let _ = (text.parse::<FrameRange>(), text.parse::<Lighting>(), text.parse::<ExrFrames>(), file::parse(&text));
    }

    #[test]
    fn no_json_makes_the_reader_panic(key in "[a-z_$]{0,8}", value in "[\\[\\]{}0-9\",:a-z]{0,12}") {
        let _ = file::parse(&format!("{{\"{key}\": {value}}}"));
    }
}
