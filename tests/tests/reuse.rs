//! A stranger reuses one crate: own primitives in the index, one shape of the geometry, a frame written as EXR.

use glam::{Vec3, vec3};
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BspTree, BuildParams, Primitives, RayIndex};

/// A primitive that Heliostat does not know: a ball given by centre and radius.
struct Balls(Vec<(Vec3, f32)>);

impl Primitives for Balls {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, i: u32) -> Aabb {
        let (centre, radius) = self.0[i as usize];
        Aabb { min: centre - radius, max: centre + radius }
    }
}

impl Balls {
    fn hit(&self, i: u32, ray: &Ray) -> Option<(f32, Vec3)> {
        let (centre, radius) = self.0[i as usize];
        let to = ray.origin - centre;
        let (a, b) = (ray.dir.length_squared(), to.dot(ray.dir));
        let root = b * b - a * (to.length_squared() - radius * radius);
        let t = (-b - root.max(0.0).sqrt()) / a;
        (root >= 0.0 && ray.range.contains(t)).then(|| (t, (ray.at(t) - centre) / radius))
    }
}

#[test]
fn the_index_takes_primitives_of_a_stranger() {
    let balls = Balls((0..100).map(|i| (vec3(i as f32 * 3.0, (i % 7) as f32, 0.0), 1.0)).collect());
    let tree = BspTree::build(&balls, &BuildParams::default()).expect("finite balls");
    // The ray runs along +x at the height of ball 0; it meets ball 0 at its nearest point.
    let ray = Ray::new(vec3(-5.0, 0.0, 0.0), Vec3::X);
    let found = tree.closest_hit(&ray, |i, ray| balls.hit(i, ray)).expect("ball 0 lies ahead");
    assert_eq!((found.primitive, found.t, found.data), (0, 4.0, Vec3::NEG_X));
    assert!(!tree.any_hit(&Ray::new(vec3(0.0, 50.0, 0.0), Vec3::Y), |i, ray| balls.hit(i, ray).is_some()));
}
