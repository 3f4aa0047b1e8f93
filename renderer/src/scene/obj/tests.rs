mod faces;
mod materials;
mod odd_lines;

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::super::image::tests::png;
use super::super::{Scene, load, load_strictly};
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
fn nothing_to_draw_is_an_error() {
    for obj in [&b"v 0 0 0\n"[..], b"", b"some text\nf 1 2 3\n", b"v 0 0 0\nv 1 0 0\nf 1 2\n"] {
        let text = error(&Files::new(&[("a.obj", obj)]), "a.obj");
        assert!(text.starts_with("has no triangle to draw"), "{text}");
    }
    let binary = Files::new(&[("a.obj", b"v 0 0 0\n\0\x01\x02")]);
    assert!(error(&binary, "a.obj").starts_with("line 2: holds a NUL byte"));
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
