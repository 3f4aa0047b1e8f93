//! Where the meshes around lights lie, by all ways of rasterising that the device has: to the bit what the CPU twin finds.

use super::cases::{points_and_spots, sliced};
use super::{Context, Verdict};
use crate::assign::Conservative::{self, Compute, Hardware, HardwareLayers, Software, SoftwareLayers};
use crate::buffers::BufferName;
use crate::cpu::{self, ShellGrid};
use crate::engine::workbench::{Case, Workbench, given};
use crate::geometry::{Grid, LightMesh, MeshKind, SliceLaw, SphereLevel};
use crate::gpu_interface::MeshFrame;
use crate::lights::Light;
use crate::measure::Capacities;
use crate::passes::{lights as light_upload, raster};
use crate::vk::Limits;
use crate::{Error, Result};

const WAYS: [Conservative; 5] = [Compute, Software, SoftwareLayers, Hardware, HardwareLayers];

const LAW: SliceLaw = SliceLaw::SecondPlane { metres: 5.0 };

/// Points and spots, many of them around the eye or cut by the camera's planes.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let (grid, lights) = (sliced(LAW), points_and_spots(900));
    let limits = rasterising(context, Compute, (&grid, &lights))?.session.context.limits.clone();
    let mut ways: Vec<String> = vec![];
    let mut seen = 0;
    for way in WAYS.into_iter().filter(|way| has(&limits, *way)) {
        let bench = rasterising(context, way, (&grid, &lights))?;
        bench.run(|r, frame| {
            let lights = light_upload::record(r, frame);
            raster::mesh_frames(r, frame, lights, given());
            raster::shells(r, frame, given());
        })?;
        let tiles = (grid.dimensions[0] * grid.dimensions[1]) as usize;
        let found = bench.download(BufferName::ShellRanges, tiles * lights.len())?;
        let twin = twin(&grid, &frames(bench, lights.len())?)?;
        let differ = found.iter().zip(&twin).filter(|(found, twin)| found != twin).count();
        if differ > 0 {
            let all = twin.len();
            return Ok(Verdict::Wrong(format!(
                "{way}: {differ} of {all} tiles have other slices than by the CPU"
            )));
        }
        seen = twin.iter().filter(|word| **word != cpu::SliceRange::EMPTY.to_word()).count();
        ways.push(way.to_string());
    }
    Ok(Verdict::Fine(format!("{} find the CPU twin's slices in {seen} tiles", ways.join(", "))))
}

fn rasterising<'a>(
    context: &'a mut Context,
    way: Conservative,
    (grid, lights): (&Grid, &[Light]),
) -> Result<&'a mut Workbench> {
    let [columns, rows, slices] = grid.dimensions;
    let method = format!("raster-{columns}-{rows}-{slices}-e").parse()?;
    let capacities = Capacities { visible_clusters: 1, light_indices: 1_000_000, ..Capacities::default() };
    context.rasterising(way, Case { method, grid: *grid, lights, capacities })
}

fn has(limits: &Limits, way: Conservative) -> bool {
    (limits.conservative_rasterization || !way.is_hardware())
        && (limits.shader_output_layer || !way.has_layers())
}

fn frames(bench: &mut Workbench, lights: usize) -> Result<Vec<MeshFrame>> {
    let words = bench.download(BufferName::LightFrames, size_of::<MeshFrame>() / 4 * lights)?;
    Ok(bytemuck::cast_slice(&words).to_vec())
}

/// The slices of each light and tile.
fn twin(grid: &Grid, frames: &[MeshFrame]) -> Result<Vec<u32>> {
    let no_frustum = || Error::Internal("a grid of boxes has no tiles".into());
    let (data, planes) = cpu::shell_grid(grid).ok_or_else(no_frustum)?;
    let grid = ShellGrid { grid: &data, planes: &planes };
    let [point, spot] = [MeshKind::Sphere(SphereLevel::V42), MeshKind::Spot].map(LightMesh::new);
    let shell = |frame: &MeshFrame| {
        let mesh = if frame.tip == [0.0; 3] { &point } else { &spot };
        cpu::placed_shell(&grid, mesh, frame)
    };
    Ok(frames.iter().flat_map(shell).map(cpu::SliceRange::to_word).collect())
}
