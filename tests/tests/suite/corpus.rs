//! Odd files of every kind that is read: each is either read or refused in one line, without a panic and within memory.
//!
//! Files are valid ones, changed in a few places drawn from a table. A case follows from its number alone: CI takes the
//! first 2 000 of each kind; by hand more are tried, all or those of one kind, with
//!
//! ```text
//! MANYLIGHT_CORPUS=100000 cargo test --release -p manylight-tests --test corpus -- --nocapture
//! ```

use manylight::config::{Config, Layer};
use manylight::{Error, Result, lights, recording, scene};
use rand_core::Rng;
use rand_pcg::Pcg32;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// How many cases of each kind, where not the default.
const COUNT: &str = "MANYLIGHT_CORPUS";

/// More than this at any time, bytes, is too much for a small file.
const MOST_MEMORY: u64 = 2 << 30;

const OBJ: &str = "# a scene\nmtllib a.mtl\no thing\nv -1 -1 0\nv 1 -1 0\nv 1 1 0 1 0 0\nv -1 1 0\nv 0 0.5 1\nvt 0 0\nvt 1 0\n\
    vt 1 1\nvt 0 1\nvn 0 0 1\ns off\nusemtl red\nf 1/1/1 2/2/1 3/3/1 4/4/1\ng two\nf 1 2 \\\n 5\nusemtl mapped\n\
    f -5/1 -4/2 -3/3 -1/4 -2/1\nl 1 2\nf 1//1 5//1 3//1\n";

const MTL: &str = "# materials\nnewmtl red\nKa 1 1 1\nKd 0.8 0.1 0.1\nKs 0.5 0.5 0.5\nNs 250\nd 1\nillum 2\n\nnewmtl mapped\n\
    Kd 1 1 1\nTr 0.5\nKe 0 0 1\nPr 0.5\nPm 0.1\nmap_Kd -s 2 2 1 -o 0.5 0 map.png\nmap_Bump map.png -bm 0.3\n\
    map_d -imfchan m map.png\n";

const CONFIG: &str = "{\n  \"scene\": \"street\",\n  \"recording\": \"bistro\",\n  \"methods\": [\"indi-persp-64\", \"all-lights\"],\n  \
    \"lights\": [{\"count\": 10, \"intensity\": 5, \"cutoff\": 0.5, \"r0\": 0.1}],\n  \"resolution\": [320, 180],\n  \
    \"frames\": \"0..100/40\",\n  \"runs\": 2,\n  \"exr\": [40],\n  \"assign\": [\"brute\", \"scatter\"],\n  \"strict\": true\n}\n";

const WAYPOINTS: &str = "{\n  \"format\": \"manylight.waypoints/1\",\n  \"fov\": 1.2, \"near\": 0.1, \"far\": 100, \"dt_s\": 0.05,\n  \
    \"waypoints\": [\n    {\"position\": [0, 0, 4], \"target\": [0, 0, 0], \"time_s\": 0},\n    \
    {\"position\": [0, 0.1, 4], \"target\": [0, 0, 0], \"time_s\": 0.3}\n  ]\n}\n";

const LIGHTS: &str = "x,y,z,r,g,b,i,i0,r0,r1\n0,1,2,1,1,1,100,0.5,0.1,\n-3.5,1,2,0.5,1,0,8,0.5,0.1,4\n1e3,2,3,1,1,1,20,0.5,0.1,\n";

const GLTF: &str = r#"{
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0, 2]}],
  "nodes": [
    {"mesh": 0, "children": [1], "translation": [1, 2, 3], "rotation": [0, 0, 0, 1], "scale": [1, 2, 1]},
    {"mesh": 1, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1]},
    {"extensions": {"KHR_lights_punctual": {"light": 0}}}
  ],
  "meshes": [
    {"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}]},
    {"primitives": [{"attributes": {"POSITION": 0}, "mode": 5}]}
  ],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2",
     "sparse": {"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}}
  ],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 36, "byteStride": 12},
    {"buffer": 0, "byteOffset": 36, "byteLength": 6}
  ],
  "buffers": [{BUFFER"byteLength": 44}],
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "roughnessFactor": 0.5}, "alphaMode": "MASK",
    "normalTexture": {"index": 0, "scale": 0.5}, "emissiveFactor": [0, 0, 1]}],
  "textures": [{"source": 0, "sampler": 0}],
  "samplers": [{"magFilter": 9728, "wrapS": 33071}],
  "images": [{"uri": "map.png"}],
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10, "color": [1, 1, 0.5], "range": 5}]}}
}
"#;

/// A triangle of single-precision positions, its indices, two bytes to a round size.
fn triangle() -> Vec<u8> {
    let positions = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let indices = [0_u16, 1, 2, 0];
    positions
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .chain(indices.iter().flat_map(|i| i.to_le_bytes()))
        .collect()
}

fn gltf() -> Vec<u8> {
    GLTF.replace("BUFFER", r#""uri": "a.bin", "#).into_bytes()
}

fn glb() -> Vec<u8> {
    let mut json = GLTF.replace("BUFFER", "").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let binary = triangle();
    let word = |word: usize| (word as u32).to_le_bytes().to_vec();
    let length = word(28 + json.len() + binary.len());
    let chunks =
        [word(json.len()), b"JSON".to_vec(), json, word(binary.len()), b"BIN\0".to_vec(), binary].concat();
    [b"glTF".to_vec(), word(2), length, chunks].concat()
}

/// A recording as the program writes it, without what makes it long.
fn short_recording(folder: &Path) -> Vec<u8> {
    let (waypoints, recording) = (folder.join("w.json"), folder.join("r.json"));
    fs::write(&waypoints, WAYPOINTS).unwrap();
    recording::bake(&waypoints).unwrap().save(&recording).unwrap();
    fs::read(recording).unwrap()
}

/// Seeded draws.
struct Dice(Pcg32);

impl Dice {
    /// Uniform in 0..`count`.
    fn below(&mut self, count: usize) -> usize {
        ((u64::from(self.0.next_u32()) * count as u64) >> 32) as usize
    }

    fn pick<'a, T: ?Sized>(&mut self, of: &[&'a T]) -> &'a T {
        of[self.below(of.len())]
    }
}

/// A way to change a file.
type Mutation = fn(&mut Vec<u8>, &mut Dice);

const MUTATIONS: [Mutation; 14] = [
    |bytes, dice| bytes.truncate(dice.below(bytes.len() + 1)),
    |bytes, dice| {
        if let Some(byte) = place(bytes, dice) {
            bytes[byte] ^= 1 << dice.below(8);
        }
    },
    |bytes, dice| {
        if let Some(byte) = place(bytes, dice) {
            bytes[byte] = dice.below(256) as u8;
        }
    },
    |bytes, dice| {
        let at = dice.below(bytes.len() + 1);
        let noise: Vec<_> = (0..1 + dice.below(8)).map(|_| dice.below(256) as u8).collect();
        bytes.splice(at..at, noise);
    },
    |bytes, dice| change_lines(bytes, dice, |lines, [a, _]| drop(lines.remove(a))),
    |bytes, dice| change_lines(bytes, dice, |lines, [a, b]| lines.insert(b, lines[a].clone())),
    |bytes, dice| change_lines(bytes, dice, |lines, [a, b]| lines.swap(a, b)),
    |bytes, dice| change_lines(bytes, dice, |lines, [a, _]| lines[a].extend(b" \\ ")),
    |bytes, dice| change_lines(bytes, dice, |lines, [a, _]| lines[a].clear()),
    replace_number,
    replace_number,
    |bytes, dice| {
        let mark = dice.pick(&[&b"\xef\xbb\xbf"[..], b"\xff\xfe", b"\xfe\xff"]);
        bytes.splice(0..0, mark.iter().copied());
    },
    |bytes, dice| {
        let end = dice.pick(&[&b"\r\n"[..], b"\r", b"\n\n", b"\x0b", b" "]);
        *bytes = bytes.split(|&byte| byte == b'\n').collect::<Vec<_>>().join(end);
    },
    |bytes, dice| {
        if let Some(start) = place(bytes, dice) {
            let end = (start + dice.below(64)).min(bytes.len());
            let copy = bytes[start..end].to_vec();
            let at = dice.below(bytes.len() + 1);
            bytes.splice(at..at, copy);
        }
    },
];

fn place(bytes: &[u8], dice: &mut Dice) -> Option<usize> {
    (!bytes.is_empty()).then(|| dice.below(bytes.len()))
}

/// Changes two lines picked at random, maybe the same.
fn change_lines(bytes: &mut Vec<u8>, dice: &mut Dice, change: impl Fn(&mut Vec<Vec<u8>>, [usize; 2])) {
    let mut lines: Vec<Vec<u8>> = bytes.split(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
    let picked = [dice.below(lines.len()), dice.below(lines.len())];
    change(&mut lines, picked);
    *bytes = lines.join(&b'\n');
}

/// Puts another number, or none, in the place of one.
fn replace_number(bytes: &mut Vec<u8>, dice: &mut Dice) {
    const NUMBERS: &[&str] = &[
        "",
        "-",
        "0",
        "-0",
        "-1",
        "1",
        "2",
        "255",
        "65536",
        "2147483648",
        "4294967295",
        "4294967296",
        "9223372036854775807",
        "99999999999999999999",
        "-9223372036854775808",
        "1e-45",
        "1e38",
        "-1e38",
        "1e39",
        "1e308",
        "1e999",
        "NaN",
        "inf",
        "-inf",
        "0.5",
        "1.5",
        "null",
        "\"x\"",
        "[]",
        "{}",
        "1/2/3/4",
        "0x10",
        "1,5",
        "1.#IND",
    ];
    fn is_digit(byte: &u8) -> bool {
        byte.is_ascii_digit() || *byte == b'.'
    }
    let Some(from) = place(bytes, dice) else { return };
    let Some(start) = bytes[from..].iter().position(is_digit).map(|at| from + at) else {
        return;
    };
    let end = bytes[start..].iter().position(|byte| !is_digit(byte)).map_or(bytes.len(), |at| start + at);
    bytes.splice(start..end, dice.pick(NUMBERS).bytes());
}

/// Tries cases of a kind: `file` is the one that is changed, `load` what reads it.
fn hold(file: &str, valid: impl Fn(&Path) -> Vec<u8>, load: fn(&Path) -> Result<()>) {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let image = image::RgbImage::from_pixel(2, 2, image::Rgb([9, 99, 199]));
    image.save(folder.join("map.png")).unwrap();
    for (name, bytes) in [("a.obj", OBJ.as_bytes()), ("a.mtl", MTL.as_bytes()), ("a.bin", &triangle())] {
        fs::write(folder.join(name), bytes).unwrap();
    }
    let path = folder.join(file);
    let valid = valid(folder);
    fs::write(&path, &valid).unwrap();
    load(folder).unwrap_or_else(|error| panic!("{file} is not valid to begin with: {error}"));

    let count = std::env::var(COUNT).map_or(2000, |count| count.parse().expect("a number of cases"));
    let mut read = 0;
    for case in 0..count {
        let bytes = mutated(&valid, case);
        fs::write(&path, &bytes).unwrap();
        match catch_unwind(AssertUnwindSafe(|| load(folder))) {
            Ok(Ok(())) => read += 1,
            Ok(Err(error)) => check(&error, file, case),
            Err(_) => panic!("{file}, case {case}: {}", kept(file, &bytes).display()),
        }
    }
    println!("{file}: {count} cases, {read} of them read, {} MiB at most", most_memory() >> 20);
    assert!(most_memory() < MOST_MEMORY, "{} bytes were used", most_memory());
    // Were all refused, or none, nothing was tried.
    assert!(read > 0 && read < count, "{read} of {count} cases were read");
}

fn mutated(valid: &[u8], case: u64) -> Vec<u8> {
    let mut dice = Dice(Pcg32::new(case, 0x0dd));
    let mut bytes = valid.to_vec();
    for _ in 0..1 + dice.below(4) {
        MUTATIONS[dice.below(MUTATIONS.len())](&mut bytes, &mut dice);
    }
    bytes
}

/// An error is the user's, and one line.
fn check(error: &Error, file: &str, case: u64) {
    let text = error.to_string();
    assert_eq!(error.exit_code(), 2, "{file}, case {case}: {text}");
    assert!(!text.is_empty() && !text.contains(['\n', '\r']), "{file}, case {case}: {text:?}");
}

/// Where a file that did harm is kept.
fn kept(file: &str, bytes: &[u8]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("manylight-corpus-{file}"));
    fs::write(&path, bytes).unwrap();
    path
}

/// The most memory that this process has held so far, bytes; 0 where the system does not tell.
fn most_memory() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok())
        .map_or(0, |kibibytes| kibibytes << 10)
}

fn load_scene(path: &Path) -> Result<()> {
    let loaded = scene::load(path)?;
    loaded.validate()
}

#[test]
fn obj() {
    hold("a.obj", |_| OBJ.into(), |folder| load_scene(&folder.join("a.obj")));
}

#[test]
fn mtl() {
    hold("a.mtl", |_| MTL.into(), |folder| load_scene(&folder.join("a.obj")));
}

#[test]
fn gltf_json() {
    hold("a.gltf", |_| gltf(), |folder| load_scene(&folder.join("a.gltf")));
}

#[test]
fn gltf_binary() {
    hold("a.glb", |_| glb(), |folder| load_scene(&folder.join("a.glb")));
}

#[test]
fn configurations() {
    let load = |folder: &Path| Config::resolve(Some(&folder.join("c.json")), Layer::default()).map(drop);
    hold("c.json", |_| CONFIG.into(), load);
}

#[test]
fn recordings() {
    let load = |folder: &Path| recording::load(&folder.join("r.json").to_string_lossy()).map(drop);
    hold("r.json", short_recording, load);
}

#[test]
fn waypoints() {
    hold("w.json", |_| WAYPOINTS.into(), |folder| recording::bake(folder.join("w.json")).map(drop));
}

#[test]
fn lights_files() {
    hold("l.csv", |_| LIGHTS.into(), |folder| lights::load_csv(folder.join("l.csv")).map(drop));
}
