use super::*;

#[test]
fn faces_with_and_without_normals_in_one_group() {
    let scene = load_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\ng a\nf 1//1 2//1 3//1\nf 1 2 3\n").unwrap();
    let normals: Vec<_> = scene.vertices.iter().map(|v| v.normal).collect();
    let (given, flat) = ([0.0, 0.6, 0.8], [0.0, 0.0, 1.0]);
    assert_eq!(normals, [given, given, given, flat, flat, flat]);
}

#[test]
fn vertex_colors_and_polygons() {
    let scene = load_text(
        "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 0.2 2 0\nv -1 1 0 0 0 0\nf 1 2 3 4 5\n",
    )
    .unwrap();
    assert_eq!(scene.triangle_count(), 3);
    // sRGB 0.2 is 0.0331 of light; 2 is more than all.
    assert!(scene.vertices.iter().any(|v| v.color == [8, 255, 0, 255]));
    let partly = load_text("v 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nf 1 2 3\n").unwrap();
    let colors: Vec<_> = partly.vertices.iter().map(|v| v.color[0]).collect();
    assert_eq!(colors, [255, 55, 255]);
}

#[test]
fn polygons_that_cannot_be_cut_are_told_in_strict() {
    let crossing = "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nf 1 2 3 4\n";
    assert_eq!(load_text(crossing).unwrap().triangle_count(), 2);
    let flat = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 5\nf 1 2 3 4\n";
    assert_eq!(load_text(flat).unwrap().triangle_count(), 1);
    for (obj, what) in [
        (crossing, "line 5: a polygon whose outline crosses itself"),
        (flat, "line 7: a polygon without area"),
    ] {
        let error = load_strictly(&Files::new(&[("a.obj", obj.as_bytes())]).path("a.obj")).unwrap_err();
        assert!(error.to_string().contains(what), "{error}");
    }
}

#[test]
fn faces_may_stand_before_their_vertices_and_count_backwards() {
    let scene = load_text("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 9 9 9\n").unwrap();
    assert_eq!(scene.triangle_count(), 2);
    assert_eq!(scene.vertices[0].position, scene.vertices[3].position);
}

#[test]
fn concave_polygons_are_not_filled() {
    let scene = load_text("v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 0\nf 1 4 2 3\n").unwrap();
    let area = |corners: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|i| glam::Vec3::from(scene.vertices[corners[i] as usize].position));
        (b - a).cross(c - a).z / 2.0
    };
    assert_eq!(scene.indices.chunks(3).map(area).sum::<f32>(), 1.0);
    assert!(scene.indices.chunks(3).all(|corners| area(corners) > 0.0));
}

#[test]
fn given_normals_decide_which_side_is_the_front() {
    for (normal, turned) in [("0 0 5", false), ("0 0 -5", true), ("1 0 0", false)] {
        let scene = load_text(&format!("{QUAD}vn {normal}\nf 1//1 2//1 3//1\n")).unwrap();
        let [a, b, c] =
            [0, 1, 2].map(|i| glam::Vec3::from(scene.vertices[scene.indices[i] as usize].position));
        assert_eq!((b - a).cross(c - a).z < 0.0, turned, "{normal}");
        assert_eq!(glam::Vec3::from(scene.vertices[0].normal).length(), 1.0);
    }
}
