//! What image files say of themselves.

use exr::prelude::{AnyChannels, FlatSamples, Layer, ReadChannels, ReadLayers, Vec2, read};
use manylight_tests::manylight;
use std::path::Path;

/// Replays a frame of the street in stereo and gives the layers of its EXR, and what was noted.
fn stereo(out: &Path, more: &[&str]) -> (f32, Vec<Layer<AnyChannels<FlatSamples>>>, String) {
    let mut command = manylight();
    command.args(["replay", "--frames", "100", "--exr", "100", "--runs", "0", "--lights", "100", "--force"]);
    command.args(["--method", "indi-persp-64", "--resolution", "96x54", "--out"]).arg(out).args(more);
    let output = command.output().unwrap();
    let notes = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{notes}");
    let reader =
        read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let image = reader.from_file(out.join("indi-persp-64/frames/000100.exr")).unwrap();
    (image.attributes.pixel_aspect, image.layer_data.to_vec(), notes)
}

fn floats(layer: &Layer<AnyChannels<FlatSamples>>, name: &str) -> Vec<f32> {
    let channel = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == name).unwrap();
    channel.sample_data.values_as_f32().collect()
}

#[test]
fn the_header_tells_the_shape_of_each_eye() {
    let out = tempfile::tempdir().unwrap();
    let (aspect, layers, notes) = stereo(out.path(), &[]);
    // The left eye's tangents span 2.632 by 2.935, in pixels of 96 by 54.
    assert!((aspect - 0.5045).abs() < 1e-3, "{aspect}");
    assert!(notes.contains("96x54 does not fit the frustum of view left"), "{notes}");
    let windows = layers.iter().map(|layer| {
        let Vec2(x, y) = layer.attributes.screen_window_center;
        [x, y, layer.attributes.screen_window_width].map(|value| (value * 1e4).round() / 1e4)
    });
    assert_eq!(windows.collect::<Vec<_>>(), [[-0.0736, -0.0062, 2.6321], [0.0741, -0.0047, 2.6433]]);
    let (square, _, notes) = stereo(out.path(), &["--resolution", "96x107"]);
    assert!((square - 1.0).abs() < 0.01 && !notes.contains("does not fit"), "{square}, {notes}");
}

#[test]
fn nothing_is_covered_where_nothing_was_hit() {
    let out = tempfile::tempdir().unwrap();
    for layer in stereo(out.path(), &[]).1 {
        let (alpha, depth) = (floats(&layer, "A"), floats(&layer, "Z"));
        let hit = alpha.iter().zip(&depth).filter(|(_, depth)| depth.is_finite());
        assert!(hit.clone().count() > 1000 && hit.clone().all(|(alpha, _)| *alpha == 1.0));
        let sky: Vec<f32> = alpha
            .iter()
            .zip(&depth)
            .filter(|(_, depth)| depth.is_infinite())
            .map(|(alpha, _)| *alpha)
            .collect();
        // Glass in front of the sky covers in part.
        assert!(sky.len() > 100 && sky.iter().all(|alpha| *alpha < 1.0));
        assert!(sky.iter().filter(|alpha| **alpha == 0.0).count() * 10 > sky.len() * 9, "{sky:?}");
    }
    let multisampled = stereo(out.path(), &["--msaa", "4"]).1;
    let alpha = floats(&multisampled[0], "A");
    assert!([0.25, 0.5, 0.75].iter().all(|part| alpha.contains(part)), "edges are covered in part");
}
