//! Where photons are sent: to balls around what may throw light on, evenly by solid angle, or by the area that is seen.
//!
//! Balls may overlap. A ball is chosen by its size, so that the density of a direction is the number of balls that lie in it over
//! the sum of their sizes.

use super::smooth;
use crate::world::World;
use glam::{Vec2, Vec3};
use heliostat_geometry::warp::{cone_pdf, square_to_cone, square_to_disk, square_to_sphere};
use heliostat_geometry::{Aabb, OrthonormalFrame};
use std::f32::consts::PI;

/// So many balls are told apart; of more, one holds all.
const MOST: usize = 64;

/// Balls around all surfaces that may be mirrors or clear.
#[derive(Debug)]
pub(crate) struct Aim {
    balls: Vec<Ball>,
    bounds: Aabb,
}

#[derive(Clone, Copy, Debug)]
struct Ball {
    centre: Vec3,
    radius: f32,
}

/// A ball as it is seen from a point.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Unit direction to its centre, and half of the angle under which it is seen; pi from inside.
    axis: Vec3,
    angle: f32,
}

impl Ball {
    fn around(bounds: Aabb) -> Self {
        Self { centre: bounds.centre(), radius: 0.5 * bounds.size().length() }
    }

    fn seen_from(&self, p: Vec3) -> Seen {
        let way = self.centre - p;
        let sin = self.radius / way.length();
        let is_outside = sin < 1.0;
        if is_outside {
            Seen { axis: way.normalize(), angle: sin.asin() }
        } else {
            Seen { axis: Vec3::Z, angle: PI }
        }
    }
}

impl Seen {
    fn solid_angle(&self) -> f32 {
        cone_pdf(self.angle).recip()
    }

    fn holds(&self, dir: Vec3) -> bool {
        // Lengths of chords, which keep their digits where cosines are all 1.
        dir.distance_squared(self.axis) <= 4.0 * (0.5 * self.angle).sin().powi(2)
    }
}

impl Aim {
    /// The balls of a scene; `None` where nothing is smooth.
    pub(crate) fn new(world: &World<'_>) -> Option<Self> {
        let smooth = smooth::objects(world.scene());
        let places: Vec<_> =
            smooth.map(|object| (world.ball_around(object), world.bounds_of_object(object))).collect();
        let bounds = places.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds));
        let ball = |(ball, bounds): (Option<(Vec3, f32)>, Aabb)| match ball {
            Some((centre, radius)) => Ball { centre, radius },
            None => Ball::around(bounds),
        };
        let balls: Vec<_> = if places.len() > MOST || !bounds.is_finite() {
            vec![Ball::around(bounds)]
        } else {
            places.into_iter().map(ball).collect()
        };
        (!balls.is_empty()).then_some(Self { balls, bounds })
    }

    /// Whether what is smooth ends somewhere.
    pub(crate) fn is_bounded(&self) -> bool {
        self.bounds.is_finite()
    }

    /// Radius of what is smooth, as far as it ends somewhere.
    pub(crate) fn radius(&self) -> Option<f32> {
        let radius = self.balls.iter().map(|ball| ball.radius).fold(0.0, f32::max);
        (self.is_bounded() && radius > 0.0).then_some(radius)
    }

    /// The solid angles of all balls from a point, added up.
    pub(crate) fn solid_angle(&self, p: Vec3) -> f32 {
        self.seen_from(p).map(|seen| seen.solid_angle()).sum()
    }

    /// The areas of all balls as they are seen from afar, added up.
    pub(crate) fn area(&self) -> f32 {
        self.balls.iter().map(|ball| PI * ball.radius * ball.radius).sum()
    }

    fn seen_from(&self, p: Vec3) -> impl Iterator<Item = Seen> {
        let is_bounded = self.is_bounded();
        let all_around = Seen { axis: Vec3::Z, angle: PI };
        self.balls.iter().map(move |ball| if is_bounded { ball.seen_from(p) } else { all_around })
    }

    /// A unit direction from a point to a ball, and its density.
    pub(crate) fn direction(&self, p: Vec3, choice: f32, u: Vec2) -> (Vec3, f32) {
        let total = self.solid_angle(p);
        let (mut left, mut chosen) = (choice * total, (0, Seen { axis: Vec3::Z, angle: PI }));
        for (i, seen) in self.seen_from(p).enumerate() {
            chosen = (i, seen);
            left -= seen.solid_angle();
            if left < 0.0 {
                break;
            }
        }
        let (i, seen) = chosen;
        let dir = if seen.angle < PI {
            OrthonormalFrame::around(seen.axis).to_world(square_to_cone(u, seen.angle))
        } else {
            square_to_sphere(u)
        };
        // Rounding must not put it beside the ball that was chosen.
        let holds = |(k, seen): (usize, Seen)| k == i || seen.holds(dir);
        let count = self.seen_from(p).enumerate().filter(|&seen| holds(seen)).count();
        (dir, count as f32 / total)
    }

    /// A point in a plane across the unit direction `dir`, through the centre of a ball, and its density by area.
    pub(crate) fn place(&self, dir: Vec3, choice: f32, u: Vec2) -> (Vec3, f32) {
        let total = self.area();
        let (mut left, mut chosen) = (choice * total, 0);
        for (i, ball) in self.balls.iter().enumerate() {
            chosen = i;
            left -= PI * ball.radius * ball.radius;
            if left < 0.0 {
                break;
            }
        }
        let ball = self.balls[chosen];
        let frame = OrthonormalFrame::around(dir);
        let place = ball.centre + frame.to_world((ball.radius * square_to_disk(u)).extend(0.0));
        let holds = |(i, other): &(usize, &Ball)| {
            let way = place - other.centre;
            *i == chosen || (way - way.dot(dir) * dir).length_squared() <= other.radius * other.radius
        };
        (place, self.balls.iter().enumerate().filter(holds).count() as f32 / total)
    }

    /// A way from a place that leads out of a box in any direction.
    pub(crate) fn way_out(&self, bounds: Aabb, place: Vec3) -> f32 {
        let all = if bounds.is_finite() { bounds.union(self.bounds) } else { self.bounds };
        all.corners().map(|corner| corner.distance(place)).into_iter().fold(0.0, f32::max) * 2.0
    }
}
