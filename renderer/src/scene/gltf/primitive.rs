//! Primitives: vertex attributes and topology (glTF 2.0, section 3.7.2).

use std::collections::BTreeSet;
use std::ops::Range;

use gltf::json;
use json::mesh::{Mode, Semantic};
use json::validation::Checked;

use super::super::TextureSlot;
use super::super::mesh::{Mesh, PLAIN_VERTEX};
use super::accessor::Accessor;
use super::document::Document;
use super::material::{Materials, UvSets};
use super::nodes::Placed;
use crate::Result;

/// A primitive to build.
pub(super) struct Job<'a> {
    /// Into the document's meshes.
    pub mesh: usize,
    primitive: usize,
    json: &'a json::mesh::Primitive,
    mode: Mode,
    /// Into [`Materials::list`].
    material: u32,
}

/// A built primitive.
pub(super) struct Built {
    pub mesh: Mesh,
    /// Its material reads coordinates that it does not have.
    pub lacks_uv: bool,
}

/// The primitives of all placed meshes, by mesh; points and lines are left out with a warning.
pub(super) fn jobs<'a>(
    document: &'a Document,
    materials: &mut Materials,
    placed: &Placed,
) -> Result<Vec<Job<'a>>> {
    let meshes: BTreeSet<usize> = placed.meshes.iter().map(|node| node.mesh).collect();
    let mut jobs = Vec::new();
    let mut skipped = 0;
    for mesh in meshes {
        for (primitive, json) in document.root.meshes[mesh].primitives.iter().enumerate() {
            let mode = match json.mode {
                Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => mode,
                _ => {
                    skipped += 1;
                    continue;
                }
            };
            let material = match json.material {
                None => materials.default_material(),
                Some(material) => {
                    let known = document.get(&document.root.materials, "materials", material);
                    known
                        .map_err(|m| document.error(format!("meshes[{mesh}].primitives[{primitive}] {m}")))?;
                    material.value() as u32
                }
            };
            jobs.push(Job { mesh, primitive, json, mode, material });
        }
    }
    if skipped > 0 {
        tracing::warn!("{}: {skipped} primitives of points or lines are left out", document.path.display());
    }
    Ok(jobs)
}

/// Builds primitives.
pub(super) struct Builder<'a> {
    pub document: &'a Document,
    pub materials: &'a Materials,
}

impl Builder<'_> {
    /// Vertices and triangles of one primitive.
    pub fn build(&self, job: &Job) -> Result<Built> {
        self.checked(job).map_err(|message| {
            let name = self.document.root.meshes[job.mesh].name.as_deref().unwrap_or_default();
            self.document
                .error(format!("meshes[{}].primitives[{}] ({name}): {message}", job.mesh, job.primitive))
        })
    }

    fn checked(&self, job: &Job) -> Result<Built, String> {
        let positions = self.attribute(job, Semantic::Positions)?.ok_or("has no POSITION")?;
        positions.expect_lanes(3)?;
        let (range, indices) = self.topology(job, positions.count)?;
        let mut mesh = Mesh { vertices: vec![PLAIN_VERTEX; range.len()], indices, material: job.material };
        positions.floats(range.clone(), |i, position| mesh.vertices[i].position = position);
        if let Some(vertex) = mesh.first_bad_position() {
            return Err(format!("POSITION of vertex {} is not finite", range.start + vertex));
        }
        let lacks_uv =
            self.read_uvs(job, &mut mesh, range.clone(), &self.materials.uv_sets[job.material as usize])?;
        self.read_colors(job, &mut mesh, range.clone())?;
        self.read_frame(job, &mut mesh, range)?;
        Ok(Built { mesh, lacks_uv })
    }

    fn attribute(&self, job: &Job, semantic: Semantic) -> Result<Option<Accessor<'_>>, String> {
        let name = semantic.to_string();
        let index = job.json.attributes.get(&Checked::Valid(semantic));
        let accessor = index.map(|&index| Accessor::new(self.document, index)).transpose();
        accessor.map_err(|message| format!("{name}: {message}"))
    }

    /// The vertices in use and the triangles between them, counted from the first in use: primitives that
    /// share one large accessor take only their part of it.
    fn topology(&self, job: &Job, count: usize) -> Result<(Range<usize>, Vec<u32>), String> {
        let listed = match job.json.indices {
            Some(index) => Accessor::new(self.document, index).and_then(|accessor| accessor.indices()),
            None => {
                u32::try_from(count).map(|count| (0..count).collect()).map_err(|_| "too many vertices".into())
            }
        };
        let mut indices = triangles(job.mode, listed.map_err(|message| format!("indices: {message}"))?)?;
        let (Some(&first), Some(&last)) = (indices.iter().min(), indices.iter().max()) else {
            return Ok((0..0, indices));
        };
        if last as usize >= count {
            return Err(format!("indices: use vertex {last} of {count}"));
        }
        indices.iter_mut().for_each(|index| *index -= first);
        Ok((first as usize..last as usize + 1, indices))
    }

    fn read_uvs(
        &self,
        job: &Job,
        mesh: &mut Mesh,
        range: Range<usize>,
        sets: &UvSets,
    ) -> Result<bool, String> {
        let mut lacks = false;
        for (slot, set) in sets.iter().enumerate() {
            let Some(set) = *set else { continue };
            let Some(uvs) = self.attribute(job, Semantic::TexCoords(set))? else {
                lacks = true;
                continue;
            };
            uvs.expect_lanes(2)?;
            self.expect_all(job, &uvs)?;
            uvs.floats(range.clone(), |i, uv: [f32; 2]| {
                mesh.vertices[i].uv[slot] = uv.map(|x| if x.is_finite() { x } else { 0.0 });
            });
        }
        Ok(lacks)
    }

    fn read_colors(&self, job: &Job, mesh: &mut Mesh, range: Range<usize>) -> Result<(), String> {
        let Some(colors) = self.attribute(job, Semantic::Colors(0))? else { return Ok(()) };
        self.expect_all(job, &colors)?;
        let colors = colors.always_normalized();
        let unorm = |x: f32| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
        if colors.lanes == 4 {
            colors.floats(range, |i, rgba: [f32; 4]| mesh.vertices[i].color = rgba.map(unorm));
        } else {
            colors.expect_lanes(3)?;
            colors.floats(range, |i, [r, g, b]: [f32; 3]| {
                mesh.vertices[i].color = [unorm(r), unorm(g), unorm(b), 255];
            });
        }
        Ok(())
    }

    /// Normals and tangents; those that are missing or have no direction are made.
    fn read_frame(&self, job: &Job, mesh: &mut Mesh, range: Range<usize>) -> Result<(), String> {
        let material = &self.materials.list[mesh.material as usize];
        let normal_map = material.textures[TextureSlot::Normal as usize];
        let normals = self.attribute(job, Semantic::Normals)?.map(Accessor::always_normalized);
        match &normals {
            Some(normals) => {
                normals.expect_lanes(3)?;
                self.expect_all(job, normals)?;
                normals.floats(range.clone(), |i, normal| mesh.vertices[i].normal = normal);
                mesh.normalize_normals();
            }
            None => mesh.flatten_normals(),
        }
        let Some(normal_map) = normal_map else {
            mesh.set_any_tangents();
            return Ok(());
        };
        // Where normals are missing, given tangents are to be ignored.
        let tangents = self.attribute(job, Semantic::Tangents)?.filter(|_| normals.is_some());
        let Some(tangents) = tangents else {
            mesh.generate_tangents(&normal_map);
            return Ok(());
        };
        tangents.expect_lanes(4)?;
        self.expect_all(job, &tangents)?;
        tangents.always_normalized().floats(range, |i, tangent| mesh.vertices[i].tangent = tangent);
        mesh.mend_tangents();
        Ok(())
    }

    fn expect_all(&self, job: &Job, accessor: &Accessor) -> Result<(), String> {
        let positions = job.json.attributes.get(&Checked::Valid(Semantic::Positions));
        let count = positions.and_then(|&index| self.document.root.accessors.get(index.value()));
        accessor.expect_count(count.map_or(0, |positions| positions.count.0 as usize))
    }
}

/// The triangle list of any topology of triangles (glTF 2.0, section 3.7.2.1); a strip's stitches are dropped.
fn triangles(mode: Mode, indices: Vec<u32>) -> Result<Vec<u32>, String> {
    let list: Vec<[u32; 3]> = match mode {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .map(|(i, v)| if i % 2 == 0 { [v[0], v[1], v[2]] } else { [v[0], v[2], v[1]] })
            .collect(),
        Mode::TriangleFan => indices.windows(2).skip(1).map(|v| [v[0], v[1], indices[0]]).collect(),
        _ if !indices.len().is_multiple_of(3) => {
            return Err(format!("has {} indices, which do not make whole triangles", indices.len()));
        }
        _ => return Ok(indices),
    };
    Ok(list.into_iter().filter(|[a, b, c]| a != b && b != c && c != a).flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_winding() {
        let strip = triangles(Mode::TriangleStrip, vec![0, 1, 2, 3, 3, 4, 4]).unwrap();
        assert_eq!(strip, [0, 1, 2, 1, 3, 2]);
        let fan = triangles(Mode::TriangleFan, vec![7, 1, 2, 3]).unwrap();
        assert_eq!(fan, [1, 2, 7, 2, 3, 7]);
        assert!(triangles(Mode::TriangleFan, vec![7]).unwrap().is_empty());
        assert!(triangles(Mode::Triangles, vec![0, 1]).unwrap_err().contains("2 indices"));
    }
}
