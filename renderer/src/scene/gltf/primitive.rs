//! Primitives: what is to be built, and building it (glTF 2.0, section 3.7.2).

use gltf::json;
use json::mesh::{Mode, Semantic};
use json::validation::Checked;

use super::super::TextureSlot;
use super::super::mesh::{Mesh, PLAIN_VERTEX};
use super::attributes::{Attributes, Wanted};
use super::document::Document;
use super::extensions::DRACO;
use super::left_out::LeftOut;
use super::material::Materials;
use super::nodes::{Placed, Shape};
use super::topology::topology;
use crate::Result;

/// Bytes that a corner of a triangle takes at most: a vertex of its own and its index.
const CORNER_BYTES: u64 = 64;
/// Bytes that a primitive takes besides, about.
const PRIMITIVE_BYTES: u64 = 1024;
/// Bytes that any file may become.
const LEAST_BUDGET: u64 = 1 << 29;
/// Bytes that one byte of the buffers may become: a strip of 16-bit indices makes 96 of one.
const EXPANSION: u64 = 256;

/// A primitive to build.
pub(super) struct Job {
    /// Index into [`Placed::shapes`].
    pub shape: usize,
    primitive: usize,
    json: json::mesh::Primitive,
    mode: Mode,
}

impl Job {
    /// The material that the primitive names; checked.
    pub fn material(&self) -> Option<json::Index<json::Material>> {
        self.json.material
    }
}

/// A built primitive.
pub(super) struct Built {
    pub mesh: Mesh,
    /// Whether the material reads coordinates that the primitive does not have.
    pub lacks_uv: bool,
}

/// The primitives of all shapes that can be drawn.
pub(super) fn jobs(document: &Document, placed: &Placed, left_out: &mut LeftOut) -> Result<Vec<Job>> {
    let mut planner = Planner { document, left_out, jobs: Vec::new(), bytes: 0 };
    for (number, shape) in placed.shapes.iter().enumerate() {
        let of_mesh = |message: String| document.error(format!("meshes[{}]{message}", shape.mesh.value()));
        let mesh = document.get(shape.mesh).map_err(|m| document.error(format!("a node {m}")))?;
        for (primitive, json) in mesh.primitives.into_iter().enumerate() {
            let job = Job { shape: number, primitive, json, mode: Mode::Triangles };
            planner.add(job).map_err(|m| of_mesh(format!(".primitives[{primitive}] {m}")))?;
        }
    }
    Ok(planner.jobs)
}

struct Planner<'a> {
    document: &'a Document,
    left_out: &'a mut LeftOut,
    jobs: Vec<Job>,
    /// Bytes that the jobs will take, at most.
    bytes: u64,
}

impl Planner<'_> {
    /// Adds a primitive, unless it is left out.
    fn add(&mut self, job: Job) -> Result<(), String> {
        let Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) =
            job.json.mode
        else {
            self.left_out.add("primitives of points or lines left out", 1);
            return Ok(());
        };
        if let Some(kind) = self.without_data(&job.json)? {
            self.left_out.add(kind, 1);
            return Ok(());
        }
        if let Some(material) = job.json.material {
            self.document.value(material)?;
        }
        self.bytes = self.bytes.saturating_add(self.size(&job.json, mode)?);
        if self.bytes > LEAST_BUDGET + EXPANSION * self.document.buffer_bytes() {
            return Err("brings the scene to more vertices than its buffers account for".into());
        }
        self.jobs.push(Job { mode, ..job });
        Ok(())
    }

    /// Why a primitive cannot be drawn for want of data, if so.
    fn without_data(&self, json: &json::mesh::Primitive) -> Result<Option<&'static str>, String> {
        let Some(&positions) = json.attributes.get(&Checked::Valid(Semantic::Positions)) else {
            return Ok(Some("primitives without positions left out"));
        };
        let compressed = json.extensions.as_ref().is_some_and(|e| e.others.contains_key(DRACO));
        if compressed {
            for &accessor in json.attributes.values().chain(&json.indices) {
                if !self.has_data(accessor)? {
                    return Ok(Some(
                        "primitives compressed with Draco (KHR_draco_mesh_compression) left out",
                    ));
                }
            }
        }
        // Without a buffer view all positions are zero (glTF 2.0, section 3.6.2.1): there is nothing to see.
        let seen = self.has_data(positions)?;
        Ok((!seen).then_some("primitives whose positions have no data (no bufferView) left out"))
    }

    fn has_data(&self, index: json::Index<json::Accessor>) -> Result<bool, String> {
        let accessor = self.document.value(index)?;
        let given = |field: &str| accessor.get(field).is_some_and(|value| !value.is_null());
        Ok(given("bufferView") || given("sparse"))
    }

    /// Bytes that a primitive takes at most.
    fn size(&self, json: &json::mesh::Primitive, mode: Mode) -> Result<u64, String> {
        let positions = json.attributes[&Checked::Valid(Semantic::Positions)];
        let listed = self.document.get(json.indices.unwrap_or(positions))?.count.0;
        let corners = if mode == Mode::Triangles { listed } else { listed.saturating_mul(3) };
        Ok(corners.saturating_mul(CORNER_BYTES).saturating_add(PRIMITIVE_BYTES))
    }
}

/// Builds primitives.
pub(super) struct Builder<'a> {
    pub document: &'a Document,
    pub materials: &'a Materials,
    pub placed: &'a Placed,
}

impl Builder<'_> {
    /// Vertices and triangles of one primitive.
    pub fn build(&self, job: &Job) -> Result<Built> {
        let shape = &self.placed.shapes[job.shape];
        self.checked(job, shape).map_err(|message| {
            let (mesh, primitive) = (shape.mesh.value(), job.primitive);
            let name = self.document.value(shape.mesh).ok().and_then(|mesh| mesh.get("name")?.as_str());
            let name = name.unwrap_or_default();
            self.document.error(format!("meshes[{mesh}].primitives[{primitive}] ({name}): {message}"))
        })
    }

    fn checked(&self, job: &Job, shape: &Shape) -> Result<Built, String> {
        let attributes = Attributes { document: self.document, json: &job.json, weights: &shape.weights };
        let positions = attributes.find(Semantic::Positions)?.ok_or("has no POSITION")?;
        let (range, indices) = topology(self.document, job.json.indices, (job.mode, positions.count))?;
        let wanted = Wanted { count: positions.count, range };
        let material = self.materials.place(job.material());
        let mut mesh = Mesh { vertices: vec![PLAIN_VERTEX; wanted.range.len()], indices, material };
        attributes.read_positions(&positions, &wanted, &mut mesh)?;
        let tex_coords = &self.materials.tex_coords[material as usize];
        let lacks_uv = attributes.read_uvs(&wanted, tex_coords, &mut mesh)?;
        attributes.read_colors(&wanted, &mut mesh)?;
        let normals = attributes.read_normals(&wanted, &mut mesh)?;
        // Where normals are missing, given tangents are to be ignored; where no normal map asks, they are not read.
        let normal_map = self.materials.list[material as usize].textures[TextureSlot::Normal as usize];
        let tangents = normals && normal_map.is_some() && attributes.read_tangents(&wanted, &mut mesh)?;
        if let Some(skin) = shape.skin {
            self.placed.skins[&skin].deform(&mut mesh, &attributes.influences(&wanted)?)?;
        }
        if normals {
            mesh.normalize_normals();
        } else {
            mesh.flatten_normals();
        }
        match normal_map {
            Some(_) if tangents => mesh.mend_tangents(),
            Some(normal_map) => mesh.generate_tangents(&normal_map),
            None => mesh.set_any_tangents(),
        }
        Ok(Built { mesh, lacks_uv })
    }
}
