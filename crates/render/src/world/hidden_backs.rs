//! Faces that are not seen from behind.
//!
//! A ray that finds a hidden back looks again from there on, with the same origin: distances, and with them depth, mist and
//! absorption, stay those of one ray.

use super::{Eye, Owner, PassingRay, SurfaceHit, World};
use glam::Vec3;

impl World<'_> {
    /// What `seen` hides, if it is the hidden back of a surface: the next that is seen, as `nearest` finds it in the rest of the
    /// ray.
    #[inline(always)]
    pub(super) fn past_hidden_backs(
        &self,
        seen: Option<SurfaceHit>,
        passing: &PassingRay,
        eye: Eye,
        nearest: impl FnMut(&PassingRay) -> Option<SurfaceHit>,
    ) -> Option<SurfaceHit> {
        if !self.hides_backs || eye.sees_hidden_backs() {
            return seen;
        }
        self.first_side(seen, passing, nearest)
    }

    #[inline(never)]
    fn first_side(
        &self,
        mut seen: Option<SurfaceHit>,
        passing: &PassingRay,
        mut nearest: impl FnMut(&PassingRay) -> Option<SurfaceHit>,
    ) -> Option<SurfaceHit> {
        let mut rest = *passing;
        while let Some(surface) = &seen
            && self.is_hidden_back(surface, rest.ray.dir)
        {
            // Each step gets at least one number further, so that this ends whatever rounding does.
            rest.ray.range.min = surface.hit.t.max(rest.ray.range.min).next_up();
            seen = nearest(&rest);
        }
        seen
    }

    /// Whether a ray in direction `dir` meets a surface from behind that is seen from the front alone.
    fn is_hidden_back(&self, surface: &SurfaceHit, dir: Vec3) -> bool {
        let Owner::Object { material, .. } = surface.owner else { return false };
        self.scene.materials[material.index()].hides_back() && surface.hit.at.ng.dot(dir) > 0.0
    }
}
