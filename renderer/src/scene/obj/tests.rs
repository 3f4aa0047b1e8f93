use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::super::image::dds::tests::solid;
use super::super::image::tests::png;
use super::super::{AlphaMode, Scene, TextureSlot, load};

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
    assert!(scene.vertices.iter().any(|v| v.color == [51, 255, 0, 255]));
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
fn broken_files_name_the_line() {
    let obj = format!("mtllib a.mtl\n{QUAD}f 1 2 3\n");
    let files = Files::new(&[("a.obj", obj.as_bytes()), ("a.mtl", b"newmtl x\nKd 1 2\n")]);
    assert_eq!(error(&files, "a.mtl"), "line 2: Kd has \"1 2\" instead of three numbers");
    let files = Files::new(&[("a.obj", b"v 0 0 0\nf 1 2 3\n")]);
    assert_eq!(error(&files, "a.obj"), "line 2: face corner 2 refers to v 2; 1 are defined so far");
    let files = Files::new(&[("a.obj", b"v 0 0 0\n")]);
    assert_eq!(error(&files, "a.obj"), "has no triangle to draw");
    let files = Files::new(&[("a.obj", b"v 1 1 1 1e-44\nf 1 1 1\n")]);
    assert_eq!(error(&files, "a.obj"), "has a position that is not finite: [inf, inf, inf]");
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
