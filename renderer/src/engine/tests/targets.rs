//! What passes say of colour targets.

use super::*;
use crate::buffers::BufferSet;
use crate::draw_list::SurfaceKind;
use crate::passes::Eyes;
use crate::passes::draws::{self, DepthUse, SurfacePass, SurfacePipelines};

#[test]
#[should_panic(expected = "shade/forward.frag: draws into [Radiance], its pass into []")]
fn a_pass_whose_targets_are_not_those_of_its_pipelines_is_a_fault() {
    let room = Capacities { visible_clusters: 16, light_indices: 16, ..Capacities::default() };
    Bench::new(PERSP, frustum_grid([2, 2, 2]), &lights(1), room).run(|r, frame| {
        let opaque = &frame.pipelines.shade[SurfaceKind::Opaque as usize];
        let pass = SurfacePass {
            eyes: Eyes::One(0),
            colors: &[],
            depth: DepthUse::Write,
            draws: &[(SurfaceKind::Opaque, SurfacePipelines::ByTextures(opaque))],
            reads: BufferSet::EMPTY,
            writes: BufferSet::EMPTY,
        };
        draws::surfaces(r, frame, &pass);
    });
}
