use super::super::super::image::dds::tests::solid;
use super::super::super::{AlphaMode, TextureSlot};
use super::*;

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
fn images_of_unused_materials_are_not_read() {
    let obj = format!("mtllib a.mtl\n{QUAD}usemtl used\nf 1 2 3\n");
    let mtl = b"Kd 1 0 0\nnewmtl unused\nmap_Kd gone.png\nnewmtl used\nKd 0 1 0\n";
    let scene = Files::new(&[("a.obj", obj.as_bytes()), ("a.mtl", mtl)]).load().unwrap();
    assert_eq!(
        (scene.materials.len(), scene.materials[0].base_color[..3].to_vec()),
        (1, vec![0.0, 1.0, 0.0])
    );
}
