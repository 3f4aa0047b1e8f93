//! Stage `cull` against its twin, command by command.

use super::*;
use crate::culling::WorldBox;
use crate::drawables::DrawableOrder;
use crate::geometry::Frustum;
use crate::geometry::views::{Mirror, Pose, View};
use crate::gpu_interface::DrawCommand;
use crate::passes::cull;
use crate::vk::{Buffer, Memory};
use ash::vk;
use glam::DQuat;

/// How close to a plane f32 may decide otherwise, metres: the planes' slack is below it.
const EPSILON: f64 = 1e-3;

/// Cameras inside, beside and outside the scene, some with little of it before them.
fn views() -> Vec<View> {
    let place = |x: f64, z: f64, yaw: f64, fov: f64| {
        let pose =
            Pose { position: DVec3::new(x, 2.0, z), rotation: DQuat::from_rotation_y(yaw), mirror: None };
        View { pose, frustum: Frustum::from_fov(fov, RESOLUTION, 0.4, 60.0).unwrap() }
    };
    let mut reflected = place(1.0, 3.0, 0.7, 1.3);
    reflected.pose.mirror = Some(Mirror { normal: DVec3::new(0.6, 0.0, 0.8), offset: -12.0 });
    vec![
        place(1.0, 3.0, 0.7, 1.3),
        reflected,
        place(-4.0, -20.0, 3.0, 0.3),
        place(200.0, 0.0, 1.6, 1.0),
        place(-9.0, 9.0, 0.0, 2.0),
    ]
}

/// What the device draws: (instances of the commands in order, commands).
fn drawn(bench: &mut Bench) -> (Vec<u32>, Vec<DrawCommand>) {
    let (commands, instances) = {
        let draws = &bench.session.draws;
        (draws.commands.size, draws.drawn_instances.size)
    };
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    let context = bench.session.context.clone();
    let read = |size| Buffer::new(&context, "test result", size, usage, Memory::Readback).unwrap();
    let (commands, instances) = (read(commands), read(instances));
    bench.run(|r, frame| {
        cull::record(r, frame);
        let Draws::Indirect { buffers, .. } = &frame.draws else { panic!("the device culls by default") };
        for (from, to) in [(&buffers.commands, &commands), (&buffers.drawn_instances, &instances)] {
            r.copy(&BufferCopy { from, to, offset: 0, size: to.size });
        }
    });
    let counts = bench.session.drawables.counts;
    let list: Vec<u32> = instances.read(0, counts.instances as usize);
    let commands: Vec<DrawCommand> = commands.read(0, bench.session.drawables.all.len());
    let of_command = |c: &DrawCommand| {
        let first = c.first_instance as usize;
        list[first..first + c.instance_count as usize].to_vec()
    };
    (commands.iter().flat_map(of_command).collect(), commands)
}

/// Instances of the drawables in the order in which commands draw them.
fn in_order(bench: &Bench, view: &View) -> Vec<u32> {
    let drawables = &bench.session.drawables;
    let mut order = DrawableOrder::default();
    order.update(drawables, view);
    let surfaces = 0..drawables.counts.surfaces;
    surfaces
        .chain(order.drawables)
        .map(|drawable| &drawables.all[drawable as usize])
        .flat_map(|drawable| drawable.first_instance..drawable.first_instance + drawable.instance_count)
        .collect()
}

fn compare(scene: &str) {
    let room = Capacities { visible_clusters: 16, light_indices: 16, ..Capacities::default() };
    let scene = by_name(scene).expect("a built-in scene");
    let few = lights(10);
    let case = Case { method: PERSP, grid: box_grid([8, 1, 1]), lights: &few, capacities: room };
    let mut bench = Bench::with_scene(&config(), &scene, case);
    let boxes: Vec<WorldBox> = bench.session.batches.boxes.clone();
    let mut counts = vec![];
    for view in views() {
        let plan = FramePlan { frame: 0, views: vec![view], grids: vec![box_grid([8, 1, 1])] };
        bench.write(&plan, &lights(10));
        let (device, commands) = drawn(&mut bench);
        assert_eq!(drawn(&mut bench), (device.clone(), commands.clone()), "a second run differs");
        let twin = cpu::cull(&boxes, &[view], EPSILON);
        let sure = |list: Vec<u32>| -> Vec<u32> {
            list.into_iter().filter(|&instance| !twin.borderline[instance as usize]).collect()
        };
        let expected = in_order(&bench, &view).into_iter().filter(|&i| twin.visible[i as usize]).collect();
        assert_eq!(sure(device.clone()), sure(expected));
        let lost = |i: &u32| twin.visible[*i as usize] && !device.contains(i);
        assert!(!(0..boxes.len() as u32).any(|i| lost(&i)), "a borderline box is lost");
        assert!(twin.borderline.iter().filter(|&&close| close).count() * 50 < boxes.len());
        counts.push(device.len());
    }
    assert!(counts.iter().all(|&count| count < boxes.len()) && counts.iter().any(|&count| count > 100));
}

#[test]
fn commands_equal_their_twin() {
    compare("street");
    compare("temple");
    compare("hall");
}
