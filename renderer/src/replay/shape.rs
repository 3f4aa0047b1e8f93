//! Whether pictures have the shape of what the views see.

use crate::Result;
use crate::geometry::views::View;
use crate::recording::Recording;

/// Pixels count as square up to this deviation.
const TOLERANCE: f64 = 0.05;

/// Says where the first view of `frame` whose pixels are not square, if any, goes wrong at `resolution` (pixels), and
/// which would fit. A view without an HMD fits always.
///
/// # Errors
/// No such frame.
pub fn shape_note(recording: &Recording, frame: u32, resolution: [u32; 2]) -> Result<Option<String>> {
    let views = recording.views(frame, resolution)?;
    let mut named = recording.view_names().into_iter().zip(&views);
    Ok(named.find_map(|(name, view)| note(name, view, resolution)))
}

fn note(name: &str, view: &View, [width, height]: [u32; 2]) -> Option<String> {
    let aspect = view.pixel_aspect([width, height]);
    if (aspect - 1.0).abs() <= TOLERANCE {
        return None;
    }
    let (factor, how) = match aspect < 1.0 {
        true => (1.0 / aspect, "as wide as high"),
        false => (aspect, "as high as wide"),
    };
    let fitting = (f64::from(height) / aspect).round();
    Some(format!(
        "{width}x{height} does not fit the frustum of view {name}: in PNG, circles come out {factor:.2} times {how}; \
         {width}x{fitting} fits"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording;

    #[test]
    fn a_resolution_that_fits_no_eye_is_named_with_one_that_does() {
        let vive = recording::load("bistro-vive").unwrap();
        let note = shape_note(&vive, 0, [320, 180]).unwrap().unwrap();
        assert!(note.starts_with("320x180 does not fit the frustum of view left"), "{note}");
        assert!(note.contains("1.98 times as wide as high; 320x357 fits"), "{note}");
        assert_eq!(shape_note(&vive, 0, [320, 357]).unwrap(), None);
        let note = shape_note(&vive, 0, [320, 720]).unwrap().unwrap();
        assert!(note.contains("2.02 times as high as wide; 320x357 fits"), "{note}");
        let mono = recording::load("bistro").unwrap();
        assert_eq!(shape_note(&mono, 0, [320, 10]).unwrap(), None);
    }
}
