use super::super::{Library, Oddities, SourceFiles};
use super::*;

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
        let mut oddities = Oddities::new(&files.path("a.obj"), false);
        let names = [("a.mtl".to_owned(), 1)];
        let read = Library::read(&files.path("a.obj"), &names, &mut SourceFiles::default(), &mut oddities);
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
