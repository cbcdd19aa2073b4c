//! Many rays from one place against a box.

use super::Verdict;
use crate::lanes::{LANES, Lanes, mask, widest};
use crate::world::shadow_rays::ShadowRays;
use glam::{DAffine3, Mat3, Vec3};
use heliostat_geometry::Transform;
use heliostat_geometry::error_bound::{gamma, local_segment};
use heliostat_geometry::shape::Cuboid;
use pulp::NullaryFnOnce;

/// A box in any position.
#[derive(Clone, Copy, Debug)]
pub(in crate::world) struct BoxTest {
    to_local: DAffine3,
    /// The linear part.
    linear: Mat3,
    /// Half of its size.
    half: Vec3,
}

/// The work of [`BoxTest::verdict`], in the space of the box.
struct Meet<'a> {
    rays: &'a ShadowRays<'a>,
    linear: Mat3,
    /// Start of the rays.
    origin: Vec3,
    /// Half size of a box that holds the true one, whatever rounding did to the rays, and of one that it holds.
    outer: Vec3,
    inner: Vec3,
    /// Components of directions below this do not count.
    least: f32,
}

impl BoxTest {
    pub(super) fn new(cuboid: &Cuboid, transform: &Transform) -> Self {
        let to_local = transform.inverse_matrix();
        Self { to_local, linear: to_local.matrix3.as_mat3(), half: 0.5 * cuboid.size }
    }

    /// Which rays meet the surface of the box.
    #[inline]
    pub(super) fn verdict(&self, rays: &ShadowRays<'_>) -> Verdict {
        let origin = self.to_local.transform_point3(rays.start.origin().as_dvec3()).as_vec3();
        let error = local_segment(origin, self.linear, rays.reach, self.half);
        let (outer, inner) = (self.half + 2.0 * error, self.half - 2.0 * error);
        // From inside, or from near the surface, other rules hold; and a box may be too thin to tell.
        if (origin.abs() - outer).max_element() <= 0.0 || inner.min_element() <= 0.0 {
            return Verdict::DOUBT;
        }
        widest(Meet { rays, linear: self.linear, origin, outer, inner, least: error })
    }
}

impl NullaryFnOnce for Meet<'_> {
    type Output = Verdict;

    #[expect(clippy::needless_range_loop, reason = "a lane is a number")]
    #[inline(always)]
    fn call(self) -> Verdict {
        let Self { rays, linear, origin, outer, inner, least } = self;
        // 1 where the ray meets the box, -1 where it does not, 0 where that is in doubt.
        let mut meets: Lanes = [0.0; LANES];
        let longer = 1.0 + gamma(8);
        for i in 0..LANES {
            let dir = linear * (rays.targets.get(i) - rays.start.origin());
            let mut around = [0.0_f32, 1.0];
            let mut within = [0.0_f32, 1.0];
            for axis in 0..3 {
                let (o, d) = (origin[axis], dir[axis]);
                let inverse = 1.0 / if d.abs() < least { least.copysign(d) } else { d };
                // The near plane is on the side that the ray comes from.
                let (outer, inner) = (outer[axis].copysign(d), inner[axis].copysign(d));
                around = [around[0].max((-outer - o) * inverse), around[1].min((outer - o) * inverse)];
                within = [within[0].max((-inner - o) * inverse), within[1].min((inner - o) * inverse)];
            }
            let misses = around[0] > longer * around[1];
            let hits = longer * within[0] < within[1];
            meets[i] = if misses {
                -1.0
            } else if hits {
                1.0
            } else {
                0.0
            };
        }
        Verdict { hit: mask(|i| meets[i] > 0.0), doubt: mask(|i| meets[i] == 0.0) }
    }
}
