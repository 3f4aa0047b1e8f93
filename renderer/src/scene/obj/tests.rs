use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::super::image::dds::tests::solid;
use super::super::image::tests::png;
use super::super::{AlphaMode, Scene, TextureSlot, load, load_strictly};
use crate::text;

const QUAD: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

struct Files(TempDir);

impl Files {
    fn new(files: &[(&str, &[u8])]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn load(&self) -> crate::Result<Scene> {
        load(&self.path("a.obj"))
    }
}

fn load_text(obj: &str) -> crate::Result<Scene> {
    Files::new(&[("a.obj", obj.as_bytes())]).load()
}

fn error(files: &Files, file: &str) -> String {
    let error = files.load().unwrap_err();
    assert_eq!(error.exit_code(), 2);
    let text = error.to_string();
    text.split_once(&format!("{file}: ")).expect(&text).1.to_owned()
}

#[test]
fn groups_and_materials_become_primitives() {
    let obj = format!(
        "mtllib lib/a.mtl\n{QUAD}g one\nusemtl red\nf 1/1 2/2 3/3 4/4\ng two\nf 1/1 2/2 3/3\nusemtl glass\nf 1 3 4\n"
    );
    let mtl = "newmtl red\nKd 1 0.5 0.25\nNs 0\nmap_Kd red.png\nnewmtl glass\nKd 1 1 1\nd 0.3\nPr 0.1\nPm 1\nKe 2 2 2\n";
    let files = Files::new(&[
        ("a.obj", obj.as_bytes()),
        ("lib/a.mtl", mtl.as_bytes()),
        ("lib/red.png", &png([2, 2], [200, 0, 0, 255])),
    ]);
    let scene = files.load().unwrap();
    let primitives: Vec<_> = scene.primitives.iter().map(|p| (p.index_count, p.material)).collect();
    assert_eq!(primitives, [(6, 0), (3, 0), (3, 1)]);
    assert_eq!((scene.name.as_str(), scene.instances.len()), ("a", 3));
    assert!(scene.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]), "computed normals");
    assert_eq!(scene.vertices[0].uv[0], [0.0, 1.0], "v is turned to run down the image");

    let [red, glass] = &scene.materials[..] else { panic!("two materials") };
    assert_eq!((red.base_color, red.roughness, red.metallic), ([1.0, 0.5, 0.25, 1.0], 1.0, 0.0));
    assert_eq!(red.alpha_mode, AlphaMode::Opaque);
    let texture = red.textures[TextureSlot::BaseColor as usize].unwrap();
    assert_eq!((texture.image, scene.images[0].srgb, scene.images[0].mips[1][0]), (0, true, 200));
    assert_eq!((glass.base_color[3], glass.alpha_mode), (0.3, AlphaMode::Blend));
    assert_eq!((glass.roughness, glass.metallic, glass.emissive), (0.1, 1.0, [2.0; 3]));
}

#[test]
fn masks_emission_and_normal_maps() {
    let mtl = "newmtl leaf\nmap_Kd -clamp on leaf.png\nmap_d mask.png\nmap_Ke leaf.png\nmap_Bump -bm 0.5 bump.png\n";
    let obj = format!("mtllib a.mtl\n{QUAD}usemtl leaf\nf 1/1 2/2 3/3 4/4\n");
    let files = Files::new(&[
        ("a.obj", obj.as_bytes()),
        ("a.mtl", mtl.as_bytes()),
        ("leaf.png", &png([2, 2], [10, 20, 30, 255])),
        ("mask.png", &png([2, 2], [77, 0, 0, 255])),
        ("bump.png", &png([2, 2], [128, 128, 255, 255])),
    ]);
    let scene = files.load().unwrap();
    let leaf = &scene.materials[0];
    let image = |slot: TextureSlot| &scene.images[leaf.textures[slot as usize].unwrap().image as usize];
    assert_eq!((leaf.alpha_mode, leaf.emissive, leaf.normal_scale), (AlphaMode::Mask, [1.0; 3], 0.5));
    // The mask has an alpha channel of its own, all ones.
    assert_eq!(image(TextureSlot::BaseColor).mips[0][..4], [10, 20, 30, 255]);
    assert_eq!(image(TextureSlot::Emissive).name, "leaf.png");
    assert!(!image(TextureSlot::Normal).srgb);
    assert_eq!(scene.vertices[0].tangent, [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn textures_are_told_by_content_and_masks_by_their_red() {
    // A DDS under a name that promises a PNG; its alpha is full, so that it masks by its red.
    let obj = format!("mtllib a.mtl\n{QUAD}usemtl x\nf 1 2 3\n");
    let files = Files::new(&[
        ("a.obj", obj.as_bytes()),
        ("a.mtl", b"newmtl x\nmap_Kd x.png\nmap_d mask.png\n"),
        ("x.png", &solid([201, 41, 31, 255])),
        ("mask.png", &solid([77, 41, 31, 255])),
    ]);
    let scene = files.load().unwrap();
    assert_eq!((scene.images[0].srgb, &scene.images[0].mips[0][..4]), (true, &[201, 41, 31, 77][..]));
}

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
fn missing_library_or_material_is_a_default() {
    for obj in ["mtllib gone.mtl\nusemtl x\n", "usemtl x\n", ""] {
        let scene = load_text(&format!("{QUAD}{obj}f 1 2 3\n")).unwrap();
        assert_eq!(scene.materials.len(), 1);
        assert_eq!((scene.materials[0].name.as_str(), scene.materials[0].metallic), ("default", 0.0));
    }
}

#[test]
fn missing_texture_names_file_and_material() {
    let obj = format!("mtllib a.mtl\n{QUAD}usemtl x\nf 1 2 3\n");
    let mtl = b"newmtl x\nmap_Kd tex\\gone.png\n";
    let files = Files::new(&[("a.obj", obj.as_bytes()), ("a.mtl", mtl)]);
    let text = error(&files, "tex/gone.png");
    assert!(text.starts_with("cannot be read: "), "{text}");
    assert!(text.contains("material x of ") && text.ends_with("a.mtl)"), "{text}");
}

#[test]
fn nothing_to_draw_is_an_error() {
    for obj in [&b"v 0 0 0\n"[..], b"", b"some text\nf 1 2 3\n", b"v 0 0 0\nv 1 0 0\nf 1 2\n"] {
        let text = error(&Files::new(&[("a.obj", obj)]), "a.obj");
        assert!(text.starts_with("has no triangle to draw"), "{text}");
    }
    let binary = Files::new(&[("a.obj", b"v 0 0 0\n\0\x01\x02")]);
    assert!(error(&binary, "a.obj").starts_with("line 2: holds a NUL byte"));
}

/// What is told of `obj`, with the scene.
fn told(obj: &str) -> (Vec<String>, Scene) {
    let files = Files::new(&[("a.obj", obj.as_bytes()), ("a.mtl", b"newmtl red\nKd 1 0 0\n")]);
    let scene = files.load().unwrap();
    (scene.warnings.clone(), scene)
}

#[test]
fn odd_lines_are_told_and_the_rest_is_drawn() {
    // What follows a quad, how many triangles there are then, what is told.
    let cases = [
        ("g\no\ns off\ns 1\n", 2, ""),
        ("usemtl\nf 1 2 3\n", 3, "line 10: usemtl without a name: the default material stands in"),
        (
            "usemtl x\nusemtl \"x\"\nf 1 2 3\n",
            3,
            "line 10: no MTL defines `x`: the default material stands in",
        ),
        ("mtllib\n", 2, "line 10: mtllib without a name: the default material stands in"),
        (
            "mtllib gone.mtl\n",
            2,
            "line 10: the library `gone.mtl` is missing: the default material stands in",
        ),
        ("\nl 1 2\nl 2 3\n", 2, "line 11: `l` is not drawn: left out (2 such lines)"),
        ("curv2 1 2\n", 2, "line 10: `curv2` is not drawn: left out"),
        ("shadow_map x\n", 2, "line 10: unknown keyword `shadow_map`: ignored"),
        ("f 1/9 2/9 3/9\n", 3, "line 10: face corner `1/9` refers to vt 9; the file has 4: drawn without"),
        ("f 1/0 2 3\n", 3, "line 10: face corner `1/0` refers to vt 0; the file has 4: drawn without"),
        ("f 1/1//1 2 3\n", 3, "line 10: face corner `1/1//1` has more than three indices: ignored"),
        ("f 1 2\n", 2, "line 10: a face of 2 corners: left out"),
        ("f\nf 1\n", 2, "line 10: a face of 0 corners: left out (2 such lines)"),
        ("f 1 2 2\n", 2, "line 10: a face of 2 different corners: left out"),
        ("f 1 2 2 3 1\n", 3, "line 10: a face with the same corner twice in a row: taken once"),
        ("f 1 2 0\n", 2, "line 10: face corner `0` refers to v 0; the file has 4: left out"),
        ("f 1 2 5\n", 2, "line 10: face corner `5` refers to v 5; the file has 4: left out"),
        ("f 1 2 -5\n", 2, "line 10: face corner `-5` refers to v -5; the file has 4: left out"),
        (
            "f 1 2 99999999999999999999\n",
            2,
            "line 10: face corner `99999999999999999999` has the index `99999999999999999999`, which is no whole number within reach: left out",
        ),
        ("f 1 /2 3\n", 2, "line 10: face corner `/2` has no position: left out"),
        (
            "f 1 a 3\n",
            2,
            "line 10: face corner `a` has the index `a`, which is no whole number within reach: left out",
        ),
        (
            "v 0 nan 0\nf 1 2 5\n",
            2,
            "line 10: v has `nan`, which is not a finite number: faces there are left out",
        ),
        (
            "v 0 1.#IND 0\nf 1 2 5\n",
            2,
            "line 10: v has `1.#IND`, which is not a finite number: faces there are left out",
        ),
        ("v 0 0\nf 1 2 5\n", 2, "line 10: v has 2 numbers; 3 are expected: faces there are left out"),
        ("v 0 2 0 0\nf 1 2 5\n", 3, "line 10: v has a weight of 0: a weight of 1 stands in"),
        (
            "v 0 2 0 1 9\nf 1 2 5\n",
            3,
            "line 10: v has 5 numbers; x y z, x y z w and x y z r g b are read: ignored",
        ),
        (
            "v 0 2 0 1 1 1\nf 1 2 5\n",
            3,
            "line 10: some vertices have colours and some have none: white stands in",
        ),
        ("vt\n", 2, "line 10: vt has 0 numbers; 1 is expected: 0 stands in"),
        ("vt 1 2 3 4\n", 2, "line 10: vt has 4 numbers; 3 are read: ignored"),
        (
            "vn 1\nf 1//1 2//1 3//1\n",
            3,
            "line 10: vn has 1 number; 3 are expected: the faces' own normal stands in",
        ),
        (
            "vn inf 0 0\nf 1//1 2//1 3//1\n",
            3,
            "line 10: vn has `inf`, which is not a finite number: the faces' own normal stands in",
        ),
        ("vn 0 0 1 7\n", 2, "line 10: vn has 4 numbers; 3 are read: ignored"),
        ("#MRGB ffffffff\n", 2, "line 10: `#MRGB` is not drawn: left out"),
    ];
    for (odd, triangles, expected) in cases {
        let obj = format!("{QUAD}f 1 2 3 4\n{odd}");
        let (messages, scene) = told(&obj);
        assert_eq!(
            messages,
            expected.split('\n').filter(|line| !line.is_empty()).collect::<Vec<_>>(),
            "{odd}"
        );
        assert_eq!(scene.triangle_count(), triangles, "{odd}");
        let files = Files::new(&[("a.obj", obj.as_bytes())]);
        let strict = load_strictly(&files.path("a.obj"));
        match expected.is_empty() {
            true => assert!(strict.is_ok()),
            false => {
                let line = expected.split_once(": ").unwrap().0;
                assert!(strict.unwrap_err().to_string().contains(&format!("a.obj: {line}: ")), "{odd}");
            }
        }
    }
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

#[test]
fn every_spelling_of_the_text_is_the_same_scene() {
    let obj =
        "mtllib my.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl red\nf 1 2 \\\n  3 4 # a square\n";
    let mtl = "newmtl red\nKd 1 0 0 # red\n";
    for (obj, mtl) in text::tests::spellings(obj).iter().zip(text::tests::spellings(mtl)) {
        let scene = Files::new(&[("a.obj", obj), ("my.mtl", &mtl)]).load().unwrap();
        assert_eq!((scene.triangle_count(), scene.materials[0].base_color), (2, [1.0, 0.0, 0.0, 1.0]));
        assert_eq!(scene.bounds().unwrap().0.to_array(), [-1.0, -1.0, 0.0]);
    }
}

#[test]
fn names_in_latin_1_quotes_and_with_comments_are_found() {
    let mtl = b"# \xa9 me\nnewmtl T\xfcr\nKd 1 0 0\nnewmtl \"two words\"\nKd 0 1 0\nnewmtl Material #25\nKd 0 0 1\nnewmtl Material #26\n";
    let find = |name: &[u8]| {
        let obj = [b"mtllib \"a b.mtl\" # library\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl ", name, b"\nf 1 2 3\n"]
            .concat();
        Files::new(&[("a.obj", &obj), ("a b.mtl", mtl)]).load().unwrap().materials.remove(0)
    };
    assert_eq!(find(b"T\xfcr").base_color[..3], [1.0, 0.0, 0.0]);
    assert_eq!(find("T\u{fc}r # door".as_bytes()).base_color[..3], [1.0, 0.0, 0.0]);
    assert_eq!(find(b"two words").base_color[..3], [0.0, 1.0, 0.0]);
    assert_eq!(find(b"Material #25").base_color[..3], [0.0, 0.0, 1.0]);
    assert_eq!(find(b"Material #26").base_color[..3], [0.8; 3]);
}

#[test]
fn several_libraries_stand_on_one_line() {
    let obj = format!("mtllib one.mtl dir\\my two.mtl\n{QUAD}usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
    let files = [
        ("a.obj", obj.as_bytes()),
        ("one.mtl", b"newmtl a\nKd 1 0 0\n"),
        ("dir/my two.mtl", b"newmtl b\nKd 0 1 0\n"),
    ];
    let scene = Files::new(&files).load().unwrap();
    let colors: Vec<_> = scene.materials.iter().map(|material| material.base_color[..2].to_vec()).collect();
    assert_eq!(colors, [[1.0, 0.0], [0.0, 1.0]]);
}

#[test]
fn odd_lines_of_materials_are_told_and_the_rest_is_used() {
    // What a material says, its colour, what is told.
    let cases = [
        ("Kd 0.5", [0.5, 0.5, 0.5, 1.0], ""),
        ("KD 1 0 0\nillum 99999\nKs nonsense\nmap_Ks no.png\nNi 1", [1.0, 0.0, 0.0, 1.0], ""),
        ("d -halo 0.25", [0.8, 0.8, 0.8, 0.25], ""),
        ("Tr 0.25", [0.8, 0.8, 0.8, 0.75], ""),
        ("Tr 0\nd 1", [0.8, 0.8, 0.8, 1.0], ""),
        (
            "Tr 1",
            [0.8, 0.8, 0.8, 1.0],
            "line 2: material `m` has Tr 1 alone, which makes it invisible or opaque: opaque",
        ),
        ("d 1\nTr 1", [0.8, 0.8, 0.8, 1.0], "line 3: material `m` has d 1 and Tr 1: opaque"),
        ("d 0", [0.8, 0.8, 0.8, 0.0], "line 1: material `m` is wholly transparent: drawn as it says"),
        ("Kd 1 0 0 1", [1.0, 0.0, 0.0, 1.0], "line 2: Kd has more than 3 numbers: ignored"),
        ("Kd 1 2", [0.8, 0.8, 0.8, 1.0], "line 2: Kd has `1 2` instead of three numbers: ignored"),
        (
            "Kd spectral a.rfl",
            [0.8, 0.8, 0.8, 1.0],
            "line 2: Kd has `spectral a.rfl` instead of three numbers: ignored",
        ),
        ("Kd 1 nan 0", [0.8, 0.8, 0.8, 1.0], "line 2: Kd has `1 nan 0` instead of three numbers: ignored"),
        ("Ns x", [0.8, 0.8, 0.8, 1.0], "line 2: Ns has `x`, which is not a finite number: ignored"),
        ("map_Kd", [0.8, 0.8, 0.8, 1.0], "line 2: map_Kd without a file: drawn without"),
        ("map_Kd \"\"", [0.8, 0.8, 0.8, 1.0], "line 2: map_Kd without a file: drawn without"),
        ("map_Kd -colorspace sRGB red.png", [1.0; 4], ""),
        (
            "map_Kd C:\\art\\red.png",
            [1.0; 4],
            "line 2: `C:/art/red.png` is not there: the one beside the MTL is taken",
        ),
        ("map_Bump red.png -bm 0.3", [0.8, 0.8, 0.8, 1.0], ""),
        ("disp red.png", [0.8, 0.8, 0.8, 1.0], "line 2: `disp` is not drawn: left out"),
        ("what 1", [0.8, 0.8, 0.8, 1.0], "line 2: unknown keyword `what`: ignored"),
        (
            "newmtl m\nKd 1 0 0",
            [1.0, 0.0, 0.0, 1.0],
            "line 2: `m` is defined in line 1 too: the later one is taken",
        ),
        (
            "newmtl\nKd 1 0 0",
            [0.8, 0.8, 0.8, 1.0],
            "line 2: newmtl without a name: the default material stands in",
        ),
    ];
    let obj = format!("mtllib a.mtl\n{QUAD}usemtl m\nf 1 2 3\n");
    for (says, color, expected) in cases {
        let mtl = format!("newmtl m\n{says}\n");
        let files =
            [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes()), ("red.png", &png([1, 1], [9, 9, 9, 255]))];
        let files = Files::new(&files);
        let mut oddities = super::Oddities::new(&files.path("a.obj"), false);
        let names = [("a.mtl".to_owned(), 1)];
        let read = super::Library::read(
            &files.path("a.obj"),
            &names,
            &mut super::SourceFiles::default(),
            &mut oddities,
        );
        let expected: Vec<_> = Some(expected).filter(|expected| !expected.is_empty()).into_iter().collect();
        assert_eq!(read.unwrap().messages(), expected, "{says}");
        assert_eq!(files.load().unwrap().materials[0].base_color, color, "{says}");
        let strict = load_strictly(&files.path("a.obj"));
        assert_eq!(strict.is_err(), !expected.is_empty(), "{says}");
        if let Err(error) = strict {
            let line = expected[0].split_once(": ").unwrap().0;
            assert!(error.to_string().contains(&format!("a.mtl: {line}: ")), "{error}");
        }
    }
}

#[test]
fn images_of_unused_materials_are_not_read() {
    let obj = format!("mtllib a.mtl\n{QUAD}usemtl used\nf 1 2 3\n");
    let mtl = b"Kd 1 0 0\nnewmtl unused\nmap_Kd gone.png\nnewmtl used\nKd 0 1 0\n";
    let scene = Files::new(&[("a.obj", obj.as_bytes()), ("a.mtl", mtl)]).load().unwrap();
    assert_eq!(
        (scene.materials.len(), scene.materials[0].base_color[..3].to_vec()),
        (1, vec![0.0, 1.0, 0.0])
    );
}

#[test]
fn the_hash_covers_libraries_and_images() {
    let obj = format!("mtllib a.mtl\n{QUAD}usemtl x\nf 1 2 3\n");
    let files = Files::new(&[
        ("a.obj", obj.as_bytes()),
        ("a.mtl", b"newmtl x\nmap_Kd x.png\n"),
        ("x.png", &png([1, 1], [1, 2, 3, 4])),
    ]);
    let first = files.load().unwrap();
    assert_eq!(first, files.load().unwrap());
    let changed = |file: &Path, bytes: &[u8]| {
        fs::write(file, bytes).unwrap();
        files.load().unwrap().sha256
    };
    let image = changed(&files.path("x.png"), &png([1, 1], [1, 2, 3, 5]));
    let library = changed(&files.path("a.mtl"), b"newmtl x\nmap_Kd x.png\nd 1\n");
    assert!(first.sha256 != image && image != library && first.sha256.len() == 64);
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(128))]

    /// Lines in any order, some of them nonsense: a valid scene or one line, never a panic.
    #[test]
    fn odd_text_never_panics(picks in proptest::collection::vec(0..24_usize, 0..40)) {
        const LINES: [&str; 24] = [
            "v 0 0 0", "v 1 0 0 0.5", "v 0 1 0", "v 1 2 3 1 1 1", "vt 0 0", "vt 1", "vn 0 0 1", "vn nan 0 0",
            "f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f -1 -2 -3", "f -1/-1/-1 -2/-1/-1 -3/-1/-1", "f 1 2",
            "f 0 0 0", "f 1/9223372036854775807 1 1", "f", "l 1 2 3", "g", "o a b", "usemtl x", "usemtl", "# f",
            "mtllib none.mtl",
        ];
        let text: Vec<_> = picks.iter().map(|&pick| LINES[pick]).collect();
        match load_text(&text.join("\n")) {
            Ok(scene) => proptest::prop_assert!(scene.validate().is_ok()),
            Err(error) => proptest::prop_assert!(!error.to_string().contains('\n')),
        }
    }
}
