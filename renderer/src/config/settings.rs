//! The settings of a run, each declared once.

use super::declare::{Bearing, Setting, set, settings};
use super::values::{self, de, ser};
use super::{
    Assign, Choice, Exclude, ExrFrames, ExrLayout, FrameRange, Runs, SceneEntry, Scopes, Test, exclude,
    scenes, schema,
};
use crate::assign::{Bounds, Clusters, Compaction, Conservative, ListStore, Marking, MeshDetail};
use crate::culling::Culling;
use crate::geometry::{DisplacedVolume, NormalCones, SliceLaw, SphereLevel, VolumeTest};
use crate::lights::{
    Attenuation, GeneratorKind, LatticeBox, LightBox, LightMotion, LightSet, Lighting, SpotShare,
};
use crate::material::MaterialModel;
use crate::measure::Order;
use crate::methods::{GridBox, KINDS, Method, OctreeWay, Sharing, Space};
use crate::shading::{Shading, ShadingPipeline};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

settings! {
    /// Scene: `street`, `temple`, `hall`, `city`, or the path of a .gltf, .glb or .obj file.
    scene: String = "street".into(), Run {
        arg(long, value_name = "NAME|PATH")
        serde(default, deserialize_with = "de::text")
        schemars(length(min = 1))
        check(values::check_text)
    }
    /// Refuse an OBJ scene, or an MTL file of its, for the first line that would else be a warning.
    strict: bool = false, Outside {
        arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")
    }
    /// Recording: `bistro`, `suntem`, `hall`, `street`, `city`, `bistro-vive`, `bistro-mirror`, `suntem-vive`, `hall-vive`, or the
    /// path of a JSON file.
    recording: String = "bistro-vive".into(), Run {
        arg(long, value_name = "NAME|PATH")
        serde(default, deserialize_with = "de::text")
        schemars(length(min = 1))
        check(values::check_text)
    }
    /// Several scenes, each with its recording and maybe a resolution and frames of its own, instead of `scene`
    /// and `recording`; the flag is repeated for several. In a file they may have lights and light_volumes of their own too.
    scenes: Vec<SceneEntry> = Vec::new(), Run {
        arg(long, value_name = "SCENE=RECORDING[,WxH][,FRAMES]")
        serde(default, deserialize_with = "de::scenes")
        schemars(with = "Option<Vec<scenes::RawSceneEntry>>", length(min = 1))
        write(skip_serializing_if = "Vec::is_empty")
        check(scenes::check_all)
    }
    /// What to leave out of the product of scenes, lightings, methods, ways of assignment and tests, such as
    /// `recording=*-vive,lights=1000|10000,method=indi-persp-16`; the flag is repeated for several rules.
    exclude: Vec<Exclude> = Vec::new(), Run {
        arg(long, value_name = "AXIS=NAME[|NAME],..")
        write(skip_serializing_if = "Vec::is_empty")
        check(exclude::check_all)
    }
    /// Methods, each a run, by names with sizes.
    methods: Vec<Method> = tuned_methods(), Run {
        arg(long = "method", value_name = "METHOD", value_parser = values::method, help = methods_help())
        serde(default, deserialize_with = "de::methods")
        schemars(schema_with = "schema::methods")
        write(serialize_with = "ser::methods")
        check(values::check_methods)
    }
    /// Lights that are made: how many, intensity I (100), cut-off I0 (0.5), near radius R0 (0.1 m). Each lighting is
    /// a run of every method; the flag is repeated for several.
    lights: Vec<Lighting> = vec![Lighting::with_count(1000)], Run {
        arg(long, value_name = "N[,I,I0,R0]")
        serde(default, deserialize_with = "de::lights")
        schemars(with = "Option<Vec<Lighting>>")
        check(values::check_lights)
    }
    /// What makes the lights: `rain`, in which they fall; `gamma`, at random in a box, with gamma-distributed radii
    /// (Enhuber); or `volume`, on lattices in boxes (Tegelaers).
    light_source: GeneratorKind = GeneratorKind::Rain, Counts {
        arg(long, value_enum)
    }
    /// Seed of `gamma` and `volume` (1); rain has the recording's.
    light_seed: u64, Counts {
        arg(long, value_name = "N")
    }
    /// Where `gamma` and `volume` make lights: in the box around the scene (`scene`, the default), in that of the recording's
    /// rain (`rain`), or in a box of its own, metres.
    light_box: LightBox, Counts {
        arg(long, value_name = "scene|rain|X0,Y0,Z0,X1,Y1,Z1", allow_hyphen_values = true)
        schemars(with = "Option<String>")
    }
    /// How lights of `gamma` move: not at all (`static`, the default), or by up to 1 m/s along each axis and back at the
    /// faces of their box (`bounce`).
    light_motion: LightMotion, Counts {
        arg(long, value_enum)
    }
    /// Which part of the lights that bounce does (1); every so many-th of them, the others stay.
    light_moving: f64, Counts {
        arg(long, value_name = "PART", allow_hyphen_values = true)
        schemars(range(min = 0, max = 1))
    }
    /// Most frequent radius of `gamma`, metres (0.25); below the mean.
    light_radius_mode: f64, Counts {
        arg(long, value_name = "METRES", allow_hyphen_values = true)
        schemars(range(min = 0))
    }
    /// Mean radius of `gamma`, metres (1).
    light_radius_mean: f64, Counts {
        arg(long, value_name = "METRES", allow_hyphen_values = true)
        schemars(extend("exclusiveMinimum" = 0))
    }
    /// Boxes of `volume`, each with the lights along its axes, such as `-5,0,-5,5,4,5:10x4x10`; maybe turned about its middle by a
    /// quaternion, and with lights that end at R1 metres. Without a box it is `light_box`; without any volume that is one, with a
    /// lattice of cells that are nearly cubes. The flag is repeated for several.
    light_volumes: Vec<LatticeBox> = Vec::new(), Counts {
        arg(long = "light-volume", value_name = "[BOX:]NXxNYxNZ[:QX,QY,QZ,QW][:R1]", allow_hyphen_values = true)
        schemars(with = "Option<Vec<String>>")
        write(skip_serializing_if = "Vec::is_empty")
    }
    /// How many times as many lights the boxes of `volume` have along their axes, such as `2x_1y_3z`; as the number of lights
    /// has it where it is not given.
    light_set: LightSet, Counts {
        arg(long, value_name = "ax_by_cz")
        schemars(with = "Option<String>")
    }
    /// Which part of the lights that are made are spots, 0 to 1, each with a direction and angles by chance; half are points and
    /// half spots at 0.5.
    spots: SpotShare = SpotShare::default(), Counts {
        arg(long, value_name = "FRACTION", allow_hyphen_values = true)
        schemars(with = "Option<SpotShare>")
    }
    /// Static lights from a CSV file (columns `x,y,z,r,g,b,i,i0,r0`, maybe `r1`, and of spots `dx,dy,dz,inner,outer`) instead of
    /// made ones.
    lights_file: PathBuf, Outside {
        arg(long, value_name = "FILE.csv")
        check(values::check_path)
    }
    /// The scene's own point and spot lights (KHR_lights_punctual) instead of made ones.
    scene_lights: bool = false, Shown {
        arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")
    }
    /// Width and height of each view, pixels.
    resolution: [u32; 2] = [320, 180], Shown {
        arg(long, value_name = "WxH", value_parser = values::resolution)
        serde(default, deserialize_with = "de::resolution")
        schemars(schema_with = "schema::resolution")
        check(values::check_resolution)
    }
    /// Several resolutions, in each of which every scene is replayed that has none of its own, instead of `resolution`.
    resolutions: Vec<[u32; 2]> = Vec::new(), Run {
        arg(long, value_name = "WxH,..", value_delimiter = ',', value_parser = values::resolution)
        serde(default, deserialize_with = "de::resolutions")
        schemars(schema_with = "schema::resolutions")
        write(skip_serializing_if = "Vec::is_empty")
        check(values::check_resolutions)
    }
    /// Samples a pixel, 1 or 4.
    msaa: u32 = 1, Shown {
        arg(long, value_name = "1|4", value_parser = values::msaa)
        serde(default, deserialize_with = "de::msaa")
        schemars(schema_with = "schema::msaa")
        check(values::check_msaa)
    }
    /// Where instances outside the views are left out; what is seen is the same.
    culling: Culling = Culling::Gpu, Measures {
        arg(long, value_enum)
    }
    /// Draw all views in one pass: the prepass, the G-buffer, and opaque and masked shading where the views share a clustering.
    /// What is seen is the same.
    multiview: bool = false, Measures {
        arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")
    }
    /// Frames to render: A..B/STEP leaves B out; also A.., ..B, /STEP, or one number.
    frames: FrameRange = FrameRange { first: 0, end: None, step: 40 }, Measures {
        arg(long, value_name = "A..B/STEP")
        serde(default)
        schemars(schema_with = "schema::frames")
        check(FrameRange::check)
    }
    /// Temporal runs, in which stages are timed: a number, of which 0 leaves the counting run alone, or `auto`: on and on, until
    /// times are as precise as --precision asks for.
    runs: Runs = Runs::Fixed(2), Measures {
        arg(long, value_name = "N|auto")
        serde(default)
        schemars(schema_with = "schema::runs")
    }
    /// Order of the temporal runs of what shares scene, recording and resolution.
    order: Order = Order::Interleaved, Measures {
        arg(long, value_enum)
    }
    /// With `--runs auto`: how far, in percent and to either side, the 95 % interval may reach of the mean frame time of each
    /// run, and of its ratio to the first under the same lights.
    precision: f64 = 2.0, Measures {
        arg(long, value_name = "PERCENT")
        schemars(extend("exclusiveMinimum" = 0))
    }
    /// With `--runs auto`: the most temporal runs.
    max_runs: u32 = 100, Measures {
        arg(long, value_name = "N")
        schemars(range(min = 2))
    }
    /// Frames whose EXR and PNG images are written: numbers with commas between, `all`, `none`, or `discontinuity` (the flag
    /// alone): that of least and that of most depth discontinuity, which are found and told.
    exr: ExrFrames = ExrFrames::List(Vec::new()), Measures {
        arg(long, value_name = "LIST|all|none|discontinuity", num_args = 0..=1, default_missing_value = "discontinuity")
        serde(default)
        schemars(schema_with = "schema::exr")
    }
    /// How an EXR image holds several views: as parts, or in one part with channels named by view (`right.R`).
    exr_layout: ExrLayout = ExrLayout::Multipart, Measures {
        arg(long, value_enum)
    }
    /// Frames of the temporal runs whose CPU and GPU stages go to `trace.json`, for Perfetto or chrome://tracing:
    /// numbers with commas between, `all` (the flag alone) or `none`.
    trace: ExrFrames = ExrFrames::List(Vec::new()), Measures {
        arg(long, value_name = "LIST|all|none", num_args = 0..=1, default_missing_value = "all")
        serde(default)
        schemars(schema_with = "schema::trace")
        check(ExrFrames::check_named)
    }
    /// How a light fades with distance: phy, red, smo, phy_red_1, phy_red_2, phy_smo_1, phy_smo_2, lin, stp, or
    /// tegelaers.
    attenuation: Attenuation = Attenuation::PhyRed2, Counts {
        arg(long, value_name = "NAME")
        serde(default, deserialize_with = "de::attenuation")
        schemars(schema_with = "schema::attenuation")
        write(serialize_with = "ser::attenuation")
    }
    /// What surfaces are made of: `textured`, as the scene has it, or `white`, Lambert without 1/pi over an even tenth, with
    /// neither textures nor normal maps (Tegelaers, whose lights fade by `attenuation` tegelaers). Alpha is the scene's.
    material: MaterialModel = MaterialModel::Textured, Counts {
        arg(long, value_enum)
    }
    /// What the visible clusters of opaque and masked geometry are marked from.
    marking: Marking = Marking::Depth, Counts {
        arg(long, value_enum)
        told("marking from")
    }
    /// Which clusters get light lists: `visible` (those that hold a fragment, which marking finds), `all` of the grid, with
    /// nothing marked, or `auto`: what the method's name says, visible ones for most; of methods g and m it is always all.
    /// Of several, with commas between, each is a run of every method.
    clusters: Vec<Choice<Clusters>> = vec![Choice::Auto], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::choice::<Clusters>)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::clusters")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// What of a cluster is tested against lights: `implicit` (its cell of the grid), `measured` (what its samples take of that),
    /// or `auto`: what the method's name says, implicit for most. Of several, with commas between, each is a run of every method.
    bounds: Vec<Choice<Bounds>> = vec![Choice::Auto], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::choice::<Bounds>)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::bounds")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// Which lights are left out of the lists of clusters whose samples all face away from them, where bounds are measured: each face
    /// of a cube is divided into N x N squares, whose cones of normals are told apart, N being 1 to 3; or 0: none are. Of several, with
    /// commas between, each is a run of every such method.
    normal_cones: Vec<NormalCones> = vec![NormalCones::OFF], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::normal_cones)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::normal_cones")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// Where the slices of perspective grids begin: `geometric`, `cubes` (about as deep as a tile is high; their number follows),
    /// `second-plane-METRES` (the first ends there, the others are geometric), `linear` (from the eye), `uniform-ndc` (in projected
    /// depth), `uniform-view` (from the near plane), or `auto`: what the method's name
    /// says, geometric for most. Of several, with commas between, each is a run of
    /// every method.
    slices: Vec<Choice<SliceLaw>> = vec![Choice::Auto], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::choice::<SliceLaw>)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::slices")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// How the light lists lie in memory: `offsets` (one behind the other, once their lengths are counted), `fixed-N` (N entries
    /// each, and more where a list needs more), `capped-N` (each in a range that a counter hands out, of its first N lights: the
    /// others are dropped, and counted), or, of methods that rasterise meshes, `linked-64` and `linked-32` (from node to node, of so many
    /// bits), which are sorted once they are filled but with `-unsorted` behind, when sums of light differ from run to run in
    /// their last bits. Of several, with commas between, each is a run of every method.
    lists: Vec<ListStore> = vec![ListStore::Offsets], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::list_store)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::lists")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// How visible clusters get their places among the lists: `ranks` (by a prefix sum, in the order of the grid), `atomic` (by
    /// a counter, in any order; by brute force and hierarchy alone), or `sort` (by sorting the samples of each tile of a view's
    /// screen, tile by tile). Of several, with commas between, each is a run of every method.
    compaction: Vec<Compaction> = vec![Compaction::Ranks], Run {
        arg(long, value_enum, value_name = "LIST", value_delimiter = ',')
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::compaction")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// How raster methods find the tiles that the triangles of meshes may touch: `auto` (by hardware where the device has conservative
    /// rasterisation, else by compute), `hardware`, `software` (triangles that are grown by half a tile are drawn), both also with
    /// `-layers` (slices are left in layers of images, a light each, instead of a buffer), or `compute` (nothing is drawn: every tile
    /// around a mesh asks the triangles that may be seen in it). Of several, with commas between, each is a run of every such method.
    conservative: Vec<Conservative> = vec![Conservative::Auto], Run {
        arg(long, value_enum, value_name = "LIST", value_delimiter = ',')
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::conservative")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// How many vertices the meshes have that raster methods put around point lights: `12`, `42`, `162`, `642`, or `auto-PART` (of each
    /// light the fewest with which the mesh reaches beyond it by at most PART of a tile's width as seen from the eye). Of several, with
    /// commas between, each is a run of every such method.
    mesh_detail: Vec<MeshDetail> = vec![MeshDetail::Level(SphereLevel::V42)], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::mesh_detail)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::mesh_detail")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// How the octrees of method hashed are made: `rebuild` (anew where lights are others), `seed-N` (the same, their hashes by
    /// another seed), `shared` (leaves with the same lights share one run of light indices), `geometry` (only where the scene has
    /// surfaces), or `dynamic-SLACK` (edited where lights have changed, in tables with SLACK slots a key). Of several, with commas between, each is a run of every such method.
    octree: Vec<OctreeWay> = vec![OctreeWay::Rebuild], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::octree_way)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::octree")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// How the light lists are built; every way gives the same ones. Of several, with commas between, each is a run of
    /// every method.
    assign: Vec<Assign> = vec![Assign::Brute], Run {
        arg(long, value_enum, value_name = "LIST", value_delimiter = ',')
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::assign")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// What decides whether a light meets a cluster: `hs` (half spaces), `sat-` with letters (no separating axis among
    /// e: edges, n: to the nearest vertex, p: normals, v: to all vertices), `hs+sat-n` and the like, `exact`, `mm` (the rectangle in
    /// which the light is seen; perspective clusters), `box` (orthographic clusters and ortiz), or `auto`: what the method's name
    /// says, hs in perspective grids for most, box where it serves, exact for models, which take no other. That is asked of the sphere
    /// around what a spot light reaches; with `+cone-sat` behind it some axes are asked besides that may separate its cone, with
    /// `+cone` its cone exactly. Of several, with commas between, each is a run of every method.
    test: Vec<Test> = vec![Test::Auto], Run {
        arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::choice::<VolumeTest>)
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::test")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// How opaque and masked surfaces are shaded: after a `prepass`, so that those fragments alone are shaded that are seen, or
    /// with `overdraw`, as they are drawn, whatever hides them later: there is no prepass but where clusters are marked or measured
    /// from it. What is seen is the same. Of several, with commas between, each is a run of every method.
    shading: Vec<Shading> = vec![Shading::Prepass], Run {
        arg(long, value_enum, value_name = "LIST", value_delimiter = ',')
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::shading")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// Who evaluates lights for opaque and masked surfaces: `forward`, their fragments; or `deferred`, a pass over all pixels, by a
    /// G-buffer that keeps what is seen of them; with overdraw that is drawn in place of the prepass. Light lists are the same, and
    /// so are pictures but for what the G-buffer rounds. Of several, with commas between, each is a run of every method.
    pipeline: Vec<ShadingPipeline> = vec![ShadingPipeline::Forward], Run {
        arg(long, value_enum, value_name = "LIST", value_delimiter = ',')
        serde(default, deserialize_with = "de::ways")
        schemars(schema_with = "schema::pipeline")
        write(serialize_with = "ser::one_or_several")
        check(values::check_ways)
    }
    /// What a world grid (method g) is laid around: the centres of the frame's lights, or all geometry. Nothing is lost either
    /// way.
    grid_box: GridBox = GridBox::Lights, Counts {
        arg(long, value_enum)
    }
    /// Which frustum sizes the clusters of Displ.
    displaced_volume: DisplacedVolume = DisplacedVolume::View, Counts {
        arg(long, value_enum)
    }
    /// Output directory.
    out: PathBuf = "out".into(), Outside {
        arg(long, value_name = "DIR")
        schemars(length(min = 1))
        check(values::check_path)
    }
    /// Visible clusters that a clustering's buffers hold at first; they grow where a frame needs more.
    visible_cluster_capacity: u32 = 1 << 14, Measures {
        arg(long, value_name = "N", value_parser = values::capacity)
        serde(default, deserialize_with = "de::capacity")
        schemars(range(min = 1))
        check(values::check_capacity)
    }
    /// Light indices that a clustering's buffers hold at first; they grow where a frame needs more.
    light_index_capacity: u32 = 1 << 20, Measures {
        arg(long, value_name = "N", value_parser = values::capacity)
        serde(default, deserialize_with = "de::capacity")
        schemars(range(min = 1))
        check(values::check_capacity)
    }
    /// Device, by a part of its name or by its index in `manylight devices`.
    device: String, Outside {
        arg(long, value_name = "NAME|INDEX")
        serde(default, deserialize_with = "de::text")
        schemars(length(min = 1))
        check(values::check_text)
    }
    /// Turn the validation layers on, with synchronization validation; any message fails the run.
    validate: bool = false, Measures {
        arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")
    }
    /// Read the shader sources from this directory instead of from the program.
    shaders: PathBuf, Outside {
        arg(long, value_name = "DIR")
        check(values::check_path)
    }
    /// Which stages are timed: all; the frame as a whole, which shows what timing itself costs; or every compute pass too,
    /// which shows where the time of a stage goes, and takes longer.
    scopes: Scopes = Scopes::All, Measures {
        arg(long, value_enum)
    }
}

/// Every kind of method, a line each.
fn methods_help() -> String {
    let lines = KINDS.iter().map(|kind| format!("  {}: {}", kind.pattern(), kind.about));
    let head = "Methods, each a run; the flag is repeated for several. Sizes are numbers above 0:".to_owned();
    [head].into_iter().chain(lines).collect::<Vec<_>>().join("\n")
}

/// Persp 64, Ortho 4 and Displ 64 32, each Indi and Encl (Gelderen chapter 6).
fn tuned_methods() -> Vec<Method> {
    let spaces = [
        Space::Persp { pixels: 64.0 },
        Space::Ortho { metres: 4.0 },
        Space::Displ { pixels: 64.0, displacement: 32.0 },
    ];
    let both = [Sharing::Indi, Sharing::Encl];
    spaces.iter().flat_map(|&space| both.map(|sharing| Method::grid(sharing, space))).collect()
}
