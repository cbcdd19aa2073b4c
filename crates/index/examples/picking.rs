//! Picking in a viewer: which object lies under the mouse?
//!
//! A viewer knows a few thousand objects by their boxes. A click is a ray from the eye through the pixel; the tree
//! finds the nearest box that it meets. Run with `cargo run -p heliostat-index --example picking`.

use glam::Vec3;
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BspTree, BuildError, BuildParams, RayIndex};

/// A city of boxes on a square grid, taller towards the middle.
fn city(blocks: i32) -> Vec<Aabb> {
    let block = |x: i32, z: i32| {
        let corner = Vec3::new(4.0 * x as f32, 0.0, 4.0 * z as f32);
        let height = 30.0 / (1.0 + 0.02 * corner.length());
        Aabb { min: corner, max: corner + Vec3::new(3.0, height, 3.0) }
    };
    (-blocks..blocks).flat_map(|x| (-blocks..blocks).map(move |z| block(x, z))).collect()
}

/// The ray through a pixel of a picture that looks along -z, 60 degrees high.
fn ray_through(pixel: [u32; 2], size: [u32; 2], eye: Vec3) -> Ray {
    let half_height = 30.0_f32.to_radians().tan();
    let place = |p: u32, n: u32| (p as f32 + 0.5) - 0.5 * n as f32;
    let scale = 2.0 * half_height / size[1] as f32;
    let dir = Vec3::new(place(pixel[0], size[0]) * scale, -place(pixel[1], size[1]) * scale, -1.0);
    Ray::new(eye, dir)
}

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), BuildError> {
    let boxes = city(40);
    let tree = BspTree::build(&boxes, &BuildParams::BALANCED)?;
    let eye = Vec3::new(1.0, 45.0, 190.0);

    for pixel in [[640, 440], [640, 560], [200, 480], [640, 20]] {
        let ray = ray_through(pixel, [1280, 720], eye);
        // Here the boxes are the objects; a viewer would ask the object for its own surface.
        let found = tree.closest_hit(&ray, |i, ray| {
            let inside = boxes[i as usize].clip(ray)?;
            Some((inside.min, ()))
        });
        match found {
            Some(hit) => {
                println!("pixel {pixel:?}: object {} at {:.1}", hit.primitive, ray.at(hit.t));
            }
            None => println!("pixel {pixel:?}: sky"),
        }
    }
    Ok(())
}
