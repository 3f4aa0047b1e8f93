//! The library on small shaders in a temporary directory.

use super::*;
use crate::Error;
use tempfile::TempDir;

/// A directory of shaders, with a cache beside it.
struct Fixture {
    directory: TempDir,
    cache: TempDir,
}

impl Fixture {
    fn new(files: &[(&str, &str)]) -> Self {
        let fixture = Self { directory: TempDir::new().unwrap(), cache: TempDir::new().unwrap() };
        files.iter().for_each(|(name, text)| fixture.write(name, text));
        fixture
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.directory.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    fn library(&self) -> ShaderLibrary {
        let generated = vec![("generated/types.glsl".into(), "struct Made { float x; };\n".into())];
        let library = ShaderLibrary::new(Some(self.directory.path()), generated).unwrap();
        library.with_cache(Some(self.cache.path().to_owned()))
    }

    /// The error of compiling `path`, with the directory's name cut away.
    fn error(&self, path: &str) -> String {
        let error = self.library().compile(path, &[]).unwrap_err();
        assert!(matches!(error, Error::Input(_)), "{error:?}");
        let text = error.to_string();
        assert_eq!(text.lines().count(), 1, "{text}");
        text.replace(&format!("{}/", self.directory.path().display()), "")
    }

    fn cache_files(&self) -> Vec<PathBuf> {
        std::fs::read_dir(self.cache.path()).unwrap().map(|entry| entry.unwrap().path()).collect()
    }
}

const PLAIN: &str = "#version 460\nlayout(local_size_x = 8) in;\nvoid main() {}\n";

#[test]
fn includes_come_from_the_root_the_includers_folder_and_generated_text() {
    let fixture = Fixture::new(&[
        (
            "cluster/a.comp",
            "#version 460\n#include \"lib/one.glsl\"\n#include \"near.glsl\"\n#include \"generated/types.glsl\"\n\
             layout(local_size_x = 1) in;\nvoid main() { Made made = Made(one() + near()); }\n",
        ),
        ("lib/one.glsl", "#pragma once\nfloat one() { return 1.0; }\n"),
        ("cluster/near.glsl", "#pragma once\n#include \"lib/one.glsl\"\nfloat near() { return one(); }"),
    ]);
    let words = fixture.library().compile("cluster/a.comp", &[]).unwrap();
    assert_eq!(words[0], 0x0723_0203);
    assert_eq!(words[1], 0x0001_0600, "SPIR-V 1.6");
}

#[test]
fn an_error_in_the_root_after_an_include_has_the_roots_line() {
    let fixture = Fixture::new(&[
        ("a.comp", "// first\n#version 460\n#include \"lib/one.glsl\"\n\nvoid main() { nowhere = 1; }\n"),
        ("lib/one.glsl", "float one() {\n return 1.0;\n}\n\n\n\n\n"),
    ]);
    assert_eq!(fixture.error("a.comp"), "a.comp:5: 'nowhere' : undeclared identifier");
}

#[test]
fn an_error_in_an_include_has_its_line_and_the_include_stack() {
    let fixture = Fixture::new(&[
        ("x/a.comp", "#version 460\n\n#include \"lib/outer.glsl\"\nvoid main() { inner(); }\n"),
        ("lib/outer.glsl", "#pragma once\n\n\n#include \"lib/inner.glsl\"\n"),
        ("lib/inner.glsl", "#pragma once\nvoid inner() {\n    int i = lost;\n}\n"),
    ]);
    assert_eq!(
        fixture.error("x/a.comp"),
        "lib/inner.glsl:3: 'lost' : undeclared identifier, included from lib/outer.glsl:4, from x/a.comp:3"
    );
}

#[test]
fn an_error_after_a_skipped_second_include_keeps_its_line() {
    let fixture = Fixture::new(&[
        (
            "a.comp",
            "#version 460\n#include \"one.glsl\"\n#include \"one.glsl\"\nvoid main() { one(); lost(); }\n",
        ),
        ("one.glsl", "#pragma once\nvoid one() {}\n"),
    ]);
    assert_eq!(fixture.error("a.comp"), "a.comp:4: 'lost' : no matching overloaded function found");
}

#[test]
fn a_syntax_error_and_a_preprocessor_error_are_placed_too() {
    let fixture = Fixture::new(&[
        ("a.comp", "#version 460\n#include \"one.glsl\"\nvoid main() {}\n"),
        ("one.glsl", "\nfloat one( { return 1.0; }\n"),
        ("b.comp", "#version 460\n#include \"two.glsl\"\nvoid main() {}\n"),
        ("two.glsl", "\n\n#error not today\n"),
    ]);
    assert!(fixture.error("a.comp").starts_with("one.glsl:2: "), "{}", fixture.error("a.comp"));
    assert!(fixture.error("a.comp").contains("syntax error"));
    let error = fixture.error("b.comp");
    assert!(error.starts_with("two.glsl:3: ") && error.contains("not today"), "{error}");
    assert!(error.contains("included from b.comp:2"), "{error}");
}

#[test]
fn the_defines_of_a_failing_variant_are_named() {
    let fixture = Fixture::new(&[("a.comp", "#version 460\n#ifdef COUNT\nbad\n#endif\nvoid main() {}\n")]);
    let library = fixture.library();
    library.compile("a.comp", &[]).unwrap();
    let error =
        library.compile("a.comp", &[("COUNT", "1".into()), ("AXES", "3".into())]).unwrap_err().to_string();
    assert!(error.contains("[with AXES=3 COUNT=1]"), "{error}");
}

#[test]
fn a_missing_include_shader_or_version_is_said() {
    let fixture = Fixture::new(&[
        ("a.comp", "#version 460\n\n#include \"lib/nothing.glsl\"\nvoid main() {}\n"),
        ("b.comp", "void main() {}\n"),
    ]);
    let error = fixture.error("a.comp");
    assert!(error.starts_with("a.comp:3: ") && error.contains("lib/nothing.glsl"), "{error}");
    assert_eq!(
        fixture.error("b.comp"),
        "b.comp:1: a shader must name its language version first: #version 460"
    );
    let error = fixture.library().compile("c.comp", &[]).unwrap_err();
    assert!(error.to_string().ends_with("c.comp: no such shader"), "{error}");
    let error = ShaderLibrary::new(Some(Path::new("/nowhere/shaders")), Vec::new()).err().unwrap();
    assert_eq!(error.to_string(), "/nowhere/shaders: no such directory of shaders");
}

#[test]
fn a_missing_include_in_a_branch_not_taken_is_no_error() {
    let source = "#version 460\n#ifdef NEVER\n#include \"lib/nothing.glsl\"\n#endif\nvoid main() {}\n";
    let fixture = Fixture::new(&[("a.comp", source)]);
    fixture.library().compile("a.comp", &[]).unwrap();
}

#[test]
fn cycles_end_by_guards_and_are_reported_without_them() {
    let fixture = Fixture::new(&[
        ("a.comp", "#version 460\n#include \"one.glsl\"\nvoid main() { one(); two(); }\n"),
        ("one.glsl", "#pragma once\n#include \"two.glsl\"\nvoid one() {}\n"),
        ("two.glsl", "#ifndef TWO\n#define TWO\n#include \"one.glsl\"\nvoid two() {}\n#endif\n"),
        ("b.comp", "#version 460\n#include \"three.glsl\"\nvoid main() {}\n"),
        ("three.glsl", "\n#include \"three.glsl\"\n"),
    ]);
    fixture.library().compile("a.comp", &[]).unwrap();
    let error = fixture.error("b.comp");
    assert!(error.starts_with("three.glsl:2: ") && error.contains("#pragma once"), "{error}");
}

#[test]
fn defines_reach_the_shader_and_their_order_does_not_matter() {
    let source = "#version 460\n#if A != 1 || B != 2 || !defined(C)\nbad\n#endif\nvoid main() {}\n";
    let fixture = Fixture::new(&[("a.comp", source)]);
    let library = fixture.library();
    let one =
        library.compile("a.comp", &[("A", "1".into()), ("B", "2".into()), ("C", String::new())]).unwrap();
    let two =
        library.compile("a.comp", &[("C", String::new()), ("B", "2".into()), ("A", "1".into())]).unwrap();
    assert!(Arc::ptr_eq(&one, &two));
    assert_eq!(fixture.cache_files().len(), 1);
}

#[test]
fn a_change_of_an_included_file_or_a_define_compiles_anew() {
    let source = "#version 460\n#include \"one.glsl\"\nlayout(local_size_x = SIZE) in;\nvoid main() {}\n";
    let fixture = Fixture::new(&[("a.comp", source), ("one.glsl", "#define SIZE 4\n")]);
    let library = fixture.library();
    let before = library.compile("a.comp", &[]).unwrap();
    fixture.write("one.glsl", "#define SIZE 8\n");
    assert_ne!(before, library.compile("a.comp", &[]).unwrap());
    library.compile("a.comp", &[("OTHER", "1".into())]).unwrap();
    assert_eq!(fixture.cache_files().len(), 3);
}

#[test]
fn what_is_kept_on_disk_is_taken_and_what_is_damaged_is_not() {
    let fixture = Fixture::new(&[("a.comp", PLAIN)]);
    let words = fixture.library().compile("a.comp", &[]).unwrap();
    let [path] = fixture.cache_files().try_into().unwrap();
    let whole = std::fs::read(&path).unwrap();

    // Another valid entry under this key shows that the disk is what is read.
    let other = [0x0723_0203, 42];
    let key = key(&fixture.library().sources.closure("a.comp", &BTreeMap::new()).unwrap(), &BTreeMap::new());
    DiskCache::new(fixture.cache.path().to_owned()).store(&key, &other);
    assert_eq!(*fixture.library().compile("a.comp", &[]).unwrap(), other);

    for damaged in [&whole[..whole.len() - 1], &[], b"not a cache entry"] {
        std::fs::write(&path, damaged).unwrap();
        assert_eq!(fixture.library().compile("a.comp", &[]).unwrap(), words);
        assert_eq!(std::fs::read(&path).unwrap(), whole, "the entry is mended");
    }
}

#[test]
fn the_stage_is_the_extension() {
    let fixture = Fixture::new(&[
        ("a.vert", "#version 460\nvoid main() { gl_Position = vec4(0); }\n"),
        (
            "a.frag",
            "#version 460\nlayout(location = 0) out vec4 color;\nvoid main() { color = gl_FragCoord; }\n",
        ),
        ("a.txt", PLAIN),
    ]);
    fixture.library().compile("a.vert", &[]).unwrap();
    fixture.library().compile("a.frag", &[]).unwrap();
    assert!(fixture.library().compile("a.txt", &[]).unwrap_err().to_string().contains(".comp"));
}

#[test]
fn an_embedded_shader_that_is_missing_is_an_internal_error() {
    let library = ShaderLibrary::new(None, Vec::new()).unwrap().with_cache(None);
    assert_eq!(library.compile("no/such.comp", &[]).unwrap_err().exit_code(), 1);
}
