//! Poses over the shutter: as few as keep the picture right.
//!
//! The renderer interpolates matrices linearly between evenly spaced poses. A turning thing leaves its arc on a
//! chord, so the number of poses is doubled until no corner of its box is further than half a pixel from where it
//! belongs.

use super::SceneFile;
use super::stage::{Cast, Stage};
use crate::document::Fault;
use glam::{DAffine3, DMat3, DVec3};
use heliostat_geometry::{Aabb, Transform};
use heliostat_scene::camera::Projection;
use heliostat_scene::{Motion, RenderSettings};

/// Poses at most, less one.
const MOST_SEGMENTS: usize = 64;
/// Segments from which the search starts: enough to see a movement that returns to its beginning.
const FIRST_SEGMENTS: usize = 8;

/// How far a pixel reaches, seen from a camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelSize {
    eye: DVec3,
    /// Metres per metre of distance.
    angle: f64,
    /// Metres at any distance.
    constant: f64,
    /// Rows of the picture.
    rows: f64,
}

impl PixelSize {
    /// Pixels of a picture through a camera at `eye`.
    pub(super) fn new(eye: DVec3, projection: &Projection, settings: &RenderSettings) -> Self {
        let rows = f64::from(settings.height);
        let (angle, constant) = match *projection {
            Projection::Perspective { fov_y } | Projection::Cylindrical { fov_y, .. } => {
                (f64::from(fov_y) / rows, 0.0)
            }
            Projection::Orthographic { height } => (0.0, f64::from(height) / rows),
            Projection::Fisheye { fov } => {
                (f64::from(fov) / f64::from(settings.width.min(settings.height)), 0.0)
            }
            Projection::Panorama => (std::f64::consts::PI / rows, 0.0),
        };
        Self { eye, angle, constant, rows }
    }

    /// Half a pixel at the near side of a sphere; within it, at the distance of its radius.
    fn half_pixel(&self, centre: DVec3, radius: f64) -> f64 {
        let distance = (centre.distance(self.eye) - radius).max(radius);
        0.5 * (self.constant + self.angle * distance)
    }
}

/// The motions of all things and cameras.
#[derive(Clone, Debug)]
pub(super) struct Motions {
    /// Objects, then models, then the objects of the groups.
    pub(super) things: Vec<Motion<Transform>>,
    pub(super) cameras: Vec<Motion<DAffine3>>,
}

impl Motions {
    /// Everything stands still.
    ///
    /// # Errors
    /// When a pose has no inverse.
    pub(super) fn still(stage: &Stage) -> Result<Self, Fault> {
        let things = stage.things.iter().map(|pose| transform(pose).map(Motion::still));
        Ok(Self {
            things: things.collect::<Result<_, _>>()?,
            cameras: stage.cameras.iter().map(|&pose| Motion::still(pose)).collect(),
        })
    }

    /// Movement over the shutter; `file_at` gives the file for a share of the shutter in `[0, 1]`.
    ///
    /// # Errors
    /// Those of the file at some moment.
    pub(super) fn over_shutter(
        cast: &Cast<'_>,
        file_at: &dyn Fn(f64) -> Result<SceneFile, Fault>,
        pixel: &PixelSize,
    ) -> Result<Self, Fault> {
        let stage_at = |i: usize, segments: usize| cast.stage(&file_at(i as f64 / segments as f64)?);
        let mut segments = FIRST_SEGMENTS;
        let mut stages =
            (0..=segments).map(|i| stage_at(i, segments)).collect::<Result<Vec<Stage>, Fault>>()?;
        // Until half of the poses would do: then the other half has shown that nothing happens in between.
        while segments < MOST_SEGMENTS && !every_second_is_enough(&stages, cast, pixel) {
            let mut finer = Vec::with_capacity(2 * segments + 1);
            for (i, stage) in stages.into_iter().enumerate() {
                if i > 0 {
                    finer.push(stage_at(2 * i - 1, 2 * segments)?);
                }
                finer.push(stage);
            }
            (stages, segments) = (finer, 2 * segments);
        }
        Self::fewest(&stages, cast, pixel)
    }

    /// As few of the poses as are enough, for each by itself.
    fn fewest(stages: &[Stage], cast: &Cast<'_>, pixel: &PixelSize) -> Result<Self, Fault> {
        let first = &stages[0];
        let things = (0..first.things.len()).map(|i| {
            let poses: Vec<_> = stages.iter().map(|stage| stage.things[i]).collect();
            let test = Test::of_thing(i, &poses[0], cast, pixel);
            let poses = test.thin(&poses).iter().map(transform).collect::<Result<Vec<_>, _>>()?;
            Ok(Motion::through(poses).unwrap_or(Motion::still(Transform::IDENTITY)))
        });
        let cameras = (0..first.cameras.len()).map(|i| {
            let poses: Vec<_> = stages.iter().map(|stage| stage.cameras[i]).collect();
            let poses = Test::of_camera(pixel).thin(&poses);
            Motion::through(poses).unwrap_or(Motion::still(DAffine3::IDENTITY))
        });
        Ok(Self { cameras: cameras.collect(), things: things.collect::<Result<_, _>>()? })
    }
}

fn every_second_is_enough(stages: &[Stage], cast: &Cast<'_>, pixel: &PixelSize) -> bool {
    let first = &stages[0];
    let things = (0..first.things.len()).all(|i| {
        let test = Test::of_thing(i, &first.things[i], cast, pixel);
        test.passes(2, &|k| stages[k].things[i], stages.len())
    });
    let camera = Test::of_camera(pixel);
    things && (0..first.cameras.len()).all(|i| camera.passes(2, &|k| stages[k].cameras[i], stages.len()))
}

fn transform(pose: &DAffine3) -> Result<Transform, Fault> {
    Transform::new(*pose).ok_or_else(|| Fault::new("a transform on the way has no inverse"))
}

/// Points in local space and how far they may be from where they belong.
struct Test {
    points: Vec<DVec3>,
    tolerance: f64,
}

impl Test {
    fn of_thing(thing: usize, pose: &DAffine3, cast: &Cast<'_>, pixel: &PixelSize) -> Self {
        let bounds = cast.boxes[thing];
        // A plane without end is judged by a piece of two metres.
        let is_finite = bounds.is_finite() && !bounds.is_empty();
        let bounds = if is_finite { bounds } else { Aabb { min: glam::Vec3::NEG_ONE, max: glam::Vec3::ONE } };
        let points: Vec<_> = bounds.corners().iter().map(|corner| corner.as_dvec3()).collect();
        let centre = pose.transform_point3(super::stage::centre(bounds));
        let distance = |p: &DVec3| pose.transform_point3(*p).distance(centre);
        let radius = points.iter().map(distance).fold(0.0, f64::max);
        // What lies in a group may be placed anywhere: it is judged as if it filled the picture.
        let is_placed = thing < cast.directory.things.len();
        let tolerance = if is_placed { pixel.half_pixel(centre, radius) } else { 0.5 * radius / pixel.rows };
        Self { points, tolerance }
    }

    /// A camera is judged by what stands a metre before it.
    fn of_camera(pixel: &PixelSize) -> Self {
        let points = vec![DVec3::ZERO, DVec3::NEG_Z, DVec3::X, DVec3::Y];
        Self { points, tolerance: 0.5 * (pixel.angle + pixel.constant) }
    }

    /// Whether every `stride`-th of `count` poses gives the others.
    fn passes(&self, stride: usize, pose: &dyn Fn(usize) -> DAffine3, count: usize) -> bool {
        (0..count).filter(|i| i % stride != 0).all(|i| {
            let before = i - i % stride;
            let weight = (i % stride) as f64 / stride as f64;
            let between = lerp(&pose(before), &pose(before + stride), weight);
            let exact = pose(i);
            self.points
                .iter()
                .all(|&p| between.transform_point3(p).distance(exact.transform_point3(p)) <= self.tolerance)
        })
    }

    /// As few of the poses as are enough.
    fn thin(&self, poses: &[DAffine3]) -> Vec<DAffine3> {
        if poses.iter().all(|pose| *pose == poses[0]) {
            return vec![poses[0]];
        }
        let segments = poses.len() - 1;
        let mut stride = segments;
        while stride > 1 && !self.passes(stride, &|i| poses[i], poses.len()) {
            stride /= 2;
        }
        poses.iter().step_by(stride).copied().collect()
    }
}

/// Matrices between two poses, as the renderer takes them.
fn lerp(a: &DAffine3, b: &DAffine3, weight: f64) -> DAffine3 {
    let mix = |a: DVec3, b: DVec3| a * (1.0 - weight) + b * weight;
    DAffine3 {
        matrix3: DMat3::from_cols(
            mix(a.matrix3.x_axis, b.matrix3.x_axis),
            mix(a.matrix3.y_axis, b.matrix3.y_axis),
            mix(a.matrix3.z_axis, b.matrix3.z_axis),
        ),
        translation: mix(a.translation, b.translation),
    }
}
