//! Images read back.

use super::super::testing::view;
use super::*;
use exr::prelude::{FlatImage, ReadChannels, ReadLayers, read};

fn read_back(path: &Path) -> FlatImage {
    read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_file(path)
        .unwrap()
}

#[test]
fn stereo_reads_back_as_named_layers_with_every_channel() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("000300.exr");
    let views = [view("left", 5, 3), view("right", 5, 3)];
    write_exr(&path, &views, ExrLayout::Multipart).unwrap();
    let image = read_back(&path);
    assert_eq!(image.layer_data.len(), 2);
    for (layer, view) in image.layer_data.iter().zip(&views) {
        assert_eq!(layer.attributes.layer_name, Some(Text::from(view.name.as_str())));
        assert_eq!(layer.attributes.view_name, Some(Text::from(view.name.as_str())));
        let names: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, ["A", "B", "G", "R", "Z", "cluster_index", "fragment_count", "light_count"]);
        let samples: Vec<&FlatSamples> = layer.channel_data.list.iter().map(|c| &c.sample_data).collect();
        let red: Vec<f16> = view.color.iter().map(|pixel| pixel[0]).collect();
        assert_eq!(samples[3], &FlatSamples::F16(red));
        assert_eq!(samples[4], &FlatSamples::F32(view.depth.clone()));
        assert_eq!(samples[5], &FlatSamples::U32(view.cluster_index.clone()));
        assert_eq!(samples[6], &FlatSamples::U32(view.fragment_count.clone()));
        assert_eq!(samples[7], &FlatSamples::U32(view.light_count.clone()));
    }
}

#[test]
fn matrices_are_row_vector_matrices_to_camera_and_to_ndc() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("mono.exr");
    let mut mono = view("mono", 4, 2);
    mono.world_from_view = DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0));
    // Tangents of 1 both ways, reversed depth: near 0.5, far infinite.
    mono.clip_from_view = DMat4::from_cols_array_2d(&[
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, -1.0],
        [0.0, 0.0, 0.5, 0.0],
    ]);
    write_exr(&path, &[mono], ExrLayout::Multipart).unwrap();
    let attributes = &read_back(&path).layer_data[0].attributes;
    assert_eq!(attributes.layer_name, Some(Text::from("mono")));
    assert_eq!(attributes.view_name, None);
    let camera = attributes.world_to_camera.unwrap();
    assert_eq!(camera[12..], [-1.0, -2.0, 3.0, 1.0]);
    assert_eq!(camera[8..11], [0.0, 0.0, -1.0], "what lies ahead (world -Z) has a positive camera z");
    let ndc = attributes.world_to_normalized_device.unwrap();
    // Ten metres ahead, five to the right and ten up: three quarters across, at the upper edge.
    let point = [1.0 + 5.0, 2.0 + 10.0, 3.0 - 10.0, 1.0];
    let out: Vec<f32> =
        (0..4).map(|column| (0..4).map(|row| point[row] * ndc[row * 4 + column]).sum()).collect();
    assert!((out[0] / out[3] - 0.75).abs() < 1e-6 && (out[1] / out[3]).abs() < 1e-6, "{out:?}");
}

#[test]
fn the_header_has_the_shape_of_what_was_seen() {
    use crate::geometry::Frustum;
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("pair.exr");
    let eye = |name: &str, x0: f64, x1: f64| {
        let frustum = Frustum { x0, x1, y0: -1.0, y1: 3.0, z0: -100.0, z1: -0.1 };
        ViewPixels { clip_from_view: frustum.clip_from_view(), ..view(name, 16, 8) }
    };
    write_exr(&path, &[eye("left", -1.5, 0.5), eye("right", -0.25, 2.25)], ExrLayout::Multipart).unwrap();
    let image = read_back(&path);
    // Two by four, in sixteen by eight pixels.
    assert_eq!(image.attributes.pixel_aspect, 0.25);
    let windows = image.layer_data.iter().map(|layer| {
        let Vec2(x, y) = layer.attributes.screen_window_center;
        [x, y, layer.attributes.screen_window_width]
    });
    assert_eq!(windows.collect::<Vec<_>>(), [[-0.5, 1.0, 2.0], [1.0, 1.0, 2.5]]);
}

#[test]
fn equal_pixels_give_equal_bytes() {
    let dir = tempfile::tempdir().unwrap();
    for layout in [ExrLayout::Multipart, ExrLayout::Multiview] {
        let bytes = ["a.exr", "b.exr"].map(|name| {
            let path = dir.path().join(name);
            write_exr(&path, &[view("left", 40, 37), view("right", 40, 37)], layout).unwrap();
            std::fs::read(path).unwrap()
        });
        assert_eq!(bytes[0], bytes[1]);
    }
}

#[test]
fn one_part_has_the_channels_of_all_views_and_their_cameras() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("000300.exr");
    let mut views = [view("left", 5, 3), view("right", 5, 3)];
    views[1].world_from_view = DMat4::from_translation(DVec3::X);
    views[1].light_count.reverse();
    write_exr(&path, &views, ExrLayout::Multiview).unwrap();
    let image = read_back(&path);
    assert_eq!(image.layer_data.len(), 1);
    let layer = &image.layer_data[0];
    let names: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    let own = ["A", "B", "G", "R", "Z", "cluster_index", "fragment_count", "light_count"];
    let right = own.map(|name| format!("right.{name}"));
    assert_eq!(names, [own.map(str::to_owned), right].concat());
    for (place, view) in [(7, &views[0]), (15, &views[1])] {
        let samples = &layer.channel_data.list[place].sample_data;
        assert_eq!(samples, &FlatSamples::U32(view.light_count.clone()));
    }
    let attributes = &layer.attributes;
    let listed = ["left", "right"].map(Text::from).into_iter().collect();
    assert_eq!((&attributes.multi_view_names, &attributes.layer_name), (&Some(listed), &None));
    let Some(AttributeValue::Text(cameras)) = attributes.other.get(&Text::from(CAMERAS)) else {
        panic!("no cameras")
    };
    let cameras: serde_json::Value = serde_json::from_str(&cameras.to_string()).unwrap();
    assert_eq!(cameras["right"]["worldToCamera"][12], -1.0);
    let first: Vec<f32> = serde_json::from_value(cameras["left"]["worldToCamera"].clone()).unwrap();
    assert_eq!(first, attributes.world_to_camera.unwrap());
    assert_eq!(cameras["left"]["screenWindowWidth"], attributes.screen_window_width);
}

#[test]
fn a_single_view_is_an_image_that_knows_no_views() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("mono.exr");
    write_exr(&path, &[view("mono", 4, 2)], ExrLayout::Multiview).unwrap();
    let layer = &read_back(&path).layer_data[0];
    assert!(layer.channel_data.list.iter().all(|channel| !channel.name.to_string().contains('.')));
    assert_eq!((&layer.attributes.multi_view_names, layer.attributes.other.len()), (&None, 0));
}

#[test]
fn colour_is_that_of_what_covers_the_pixel() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("mono.exr");
    let mut mono = view("mono", 3, 1);
    mono.background = [0.5, 0.25, 8.0];
    let pixels = [[0.5, 0.25, 8.0, 0.0], [1.0, 2.0, 3.0, 1.0], [0.5, 0.375, 4.0, 0.5]];
    mono.color = pixels.map(|pixel| pixel.map(f16::from_f32)).to_vec();
    write_exr(&path, &[mono], ExrLayout::Multipart).unwrap();
    let layer = &read_back(&path).layer_data[0];
    let read = |name: &str| -> Vec<f32> {
        let found = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == name);
        found.unwrap().sample_data.values_as_f32().collect()
    };
    assert_eq!(read("R"), [0.0, 1.0, 0.25]);
    assert_eq!(read("G"), [0.0, 2.0, 0.25]);
    assert_eq!(read("B"), [0.0, 3.0, 0.0]);
    assert_eq!(read("A"), [0.0, 1.0, 0.5]);
}

#[test]
fn data_of_the_wrong_length_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("x.exr");
    let mut broken = view("mono", 4, 2);
    broken.depth.pop();
    assert!(matches!(write_exr(&path, &[broken], ExrLayout::Multipart), Err(Error::Internal(_))));
    assert!(matches!(write_exr(&path, &[], ExrLayout::Multipart), Err(Error::Internal(_))));
    assert!(!path.exists());
}
