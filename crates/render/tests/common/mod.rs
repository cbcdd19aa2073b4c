//! Small scenes in a few words, and the light along single rays through them.

#![allow(dead_code, reason = "each test file uses its own part")]
#![allow(clippy::unwrap_used, reason = "a stage that does not stand fails its test")]

use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use heliostat_geometry::shape::{Cuboid, Plane, Rectangle, Sphere, Torus};
use heliostat_geometry::{Ray, Shape, Transform, TriMesh};
use heliostat_render::integrator::create;
use heliostat_render::{CameraRay, RayCounters, Sample, Sampler, World};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, FloatInput, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::{Light, Material, MaterialId, MeshId, Motion, Object, RenderSettings, Rgb, Scene};
use std::sync::Arc;

/// A white matte surface without ambient light: radiance is irradiance.
pub(crate) fn white() -> Phong {
    Phong { ambient: grey(0.0), diffuse: grey(1.0), ..Phong::default() }
}

/// A surface that answers no light.
pub(crate) fn black() -> Phong {
    Phong { ambient: grey(0.0), diffuse: grey(0.0), ..Phong::default() }
}

/// A clear surface of an index of refraction.
pub(crate) fn glass(ior: f32) -> Phong {
    Phong { transparency: grey(1.0), ior, ..black() }
}

/// A perfect mirror.
pub(crate) fn mirror() -> Phong {
    Phong { mirror: grey(1.0), ..black() }
}

pub(crate) fn grey(v: f32) -> ColorInput {
    ColorInput::constant(Rgb::splat(v))
}

pub(crate) fn plane() -> Geometry {
    Geometry::Shape(Shape::Plane(Plane))
}

pub(crate) fn sphere(radius: f32) -> Geometry {
    Geometry::Shape(Shape::Sphere(Sphere { radius }))
}

pub(crate) fn cuboid(x: f32, y: f32, z: f32) -> Geometry {
    Geometry::Shape(Shape::Cuboid(Cuboid { size: Vec3::new(x, y, z) }))
}

pub(crate) fn rectangle(x: f32, z: f32) -> Geometry {
    Geometry::Shape(Shape::Rectangle(Rectangle { size: Vec2::new(x, z) }))
}

pub(crate) fn torus(major: f32, minor: f32) -> Geometry {
    Geometry::Shape(Shape::Torus(Torus { major, minor }))
}

/// A shift.
pub(crate) fn at(x: f32, y: f32, z: f32) -> Transform {
    Transform::translation(Vec3::new(x, y, z))
}

/// A turn about x by degrees, then a shift.
pub(crate) fn tilted(degrees: f64, x: f64, y: f64, z: f64) -> Transform {
    let turn = DMat3::from_rotation_x(degrees.to_radians());
    Transform::new(DAffine3::from_mat3_translation(turn, (x, y, z).into())).unwrap()
}

/// A scene that grows by one call per thing.
#[derive(Default)]
pub(crate) struct Stage {
    pub(crate) scene: Scene,
    pub(crate) settings: RenderSettings,
}

impl Stage {
    pub(crate) fn new() -> Self {
        Self::default()
    }

    pub(crate) fn with(mut self, geometry: Geometry, phong: Phong, place: Transform) -> Self {
        self.add(geometry, phong, place);
        self
    }

    /// Adds an object of its own material, and hands it back for changes.
    pub(crate) fn add(&mut self, geometry: Geometry, phong: Phong, place: Transform) -> &mut Object {
        let n = self.scene.objects.len();
        let material = format!("material {}", self.scene.materials.len());
        self.scene.materials.push(Material::new(material, phong));
        self.scene.objects.push(Object {
            name: format!("object {n}"),
            geometry,
            materials: vec![MaterialId(self.scene.materials.len() as u32 - 1)],
            motion: Motion::still(place),
            visible: true,
            casts_shadow: true,
        });
        self.scene.objects.last_mut().unwrap()
    }

    /// The geometry of a mesh of this scene.
    pub(crate) fn mesh(&mut self, mesh: TriMesh) -> Geometry {
        self.scene.meshes.push(Arc::new(mesh));
        Geometry::Mesh(MeshId(self.scene.meshes.len() as u32 - 1))
    }

    /// The material of the object added last.
    pub(crate) fn last_material(&mut self) -> &mut Material {
        self.scene.materials.last_mut().unwrap()
    }

    pub(crate) fn with_light(mut self, intensity: f32, samples: u32, kind: LightKind) -> Self {
        let name = format!("light {}", self.scene.lights.len());
        self.scene.lights.push(Light { name, intensity: Rgb::splat(intensity), samples, kind });
        self
    }

    pub(crate) fn with_point_light(self, intensity: f32, position: Vec3) -> Self {
        self.with_light(intensity, 1, LightKind::Point { position, falloff: Falloff::InverseSquare })
    }

    pub(crate) fn with_sky(mut self, radiance: f32) -> Self {
        self.scene.background = Background::Constant(Rgb::splat(radiance));
        self
    }

    pub(crate) fn with_opacity(mut self, opacity: f32) -> Self {
        self.last_material().opacity = FloatInput::constant(opacity);
        self
    }

    /// What comes along the ray from `from` towards `to`, for sample `sample` of a pixel.
    pub(crate) fn look_sample(&self, from: Vec3, to: Vec3, sample: u32) -> Sample {
        Looker::new(self).look(from, (to - from).normalize(), sample)
    }

    /// What comes along the ray from `from` towards `to`.
    pub(crate) fn look(&self, from: Vec3, to: Vec3) -> Sample {
        self.look_sample(from, to, 0)
    }

    /// The grey radiance that comes along the ray from `from` towards `to`.
    pub(crate) fn grey(&self, from: Vec3, to: Vec3) -> f32 {
        self.look(from, to).radiance.y
    }
}

/// A stage made ready once, for many rays.
pub(crate) struct Looker<'a> {
    pub(crate) world: World<'a>,
    integrator: Box<dyn heliostat_render::Integrator>,
    pub(crate) seed: u64,
}

impl<'a> Looker<'a> {
    pub(crate) fn new(stage: &'a Stage) -> Self {
        let world = World::new(&stage.scene, &stage.settings).unwrap();
        Self { world, integrator: create(&stage.settings), seed: 0 }
    }

    pub(crate) fn look(&self, from: Vec3, dir: Vec3, sample: u32) -> Sample {
        self.count(from, dir, sample).0
    }

    pub(crate) fn count(&self, from: Vec3, dir: Vec3, sample: u32) -> (Sample, RayCounters) {
        let ray = CameraRay {
            ray: Ray::new(from, dir),
            time: 0.0,
            eye: from,
            forward: dir,
            cone: heliostat_render::RayCone::POINT,
        };
        let mut counters = RayCounters::default();
        let mut sampler = Sampler::new(self.seed, [0, 0], sample);
        (self.integrator.radiance(&self.world, &ray, &mut sampler, &mut counters), counters)
    }
}

/// A mean and its standard deviation, per channel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimate {
    pub(crate) mean: Rgb,
    pub(crate) deviation: Rgb,
}

impl Estimate {
    /// What comes along the ray from `from` towards `to`: `samples` for each of 32 seeds, which are independent of each other.
    pub(crate) fn new(stage: &Stage, from: Vec3, to: Vec3, samples: u32) -> Self {
        const SEEDS: u64 = 32;
        let mut looker = Looker::new(stage);
        let (mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO);
        for seed in 0..SEEDS {
            looker.seed = seed;
            let one = |sample| looker.look(from, (to - from).normalize(), sample).radiance.as_dvec3();
            let mean = (0..samples).map(one).sum::<DVec3>() / f64::from(samples);
            sum += mean;
            squares += mean * mean;
        }
        let n = SEEDS as f64;
        let mean = sum / n;
        let variance = (squares / n - mean * mean).max(DVec3::ZERO) / (n - 1.0);
        Self { mean: mean.as_vec3(), deviation: variance.sqrt().as_vec3() }
    }

    /// Asserts that the mean is `expected` within four and a half deviations and a rounding: one in a hundred thousand right ones
    /// fails.
    #[track_caller]
    pub(crate) fn assert_is(&self, expected: Rgb, what: &str) {
        let allowed = 4.5 * self.deviation + 1e-4 * expected.abs() + 1e-6;
        let error = (self.mean - expected).abs();
        assert!(error.cmple(allowed).all(), "{what}: {self:?} for {expected}");
    }

    /// Asserts that two estimates are of the same number.
    #[track_caller]
    pub(crate) fn assert_same(&self, other: &Self, what: &str) {
        let squares = self.deviation * self.deviation + other.deviation * other.deviation;
        let joint = Self { mean: self.mean, deviation: squares.map(f32::sqrt) };
        joint.assert_is(other.mean, what);
    }
}

/// Asserts that two numbers agree to a share of their size, which must come from the rounding or the variance at hand.
#[track_caller]
pub(crate) fn assert_close(got: f32, expected: f32, relative: f32) {
    let error = (got - expected).abs();
    assert!(error <= relative * expected.abs().max(f32::MIN_POSITIVE), "got {got}, expected {expected}");
}

/// A sphere of triangles around the origin: `rings` from pole to pole, twice as many around; vertex normals if `smooth`.
pub(crate) fn ball_mesh(radius: f32, rings: u32, smooth: bool) -> TriMesh {
    use std::f32::consts::{PI, TAU};
    let around = 2 * rings;
    let mut mesh = TriMesh::default();
    for i in 0..=rings {
        for j in 0..around {
            let (theta, phi) = (PI * i as f32 / rings as f32, TAU * j as f32 / around as f32);
            let n = Vec3::new(theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos());
            mesh.positions.push(radius * n);
            if smooth {
                mesh.normals.push(n);
            }
        }
    }
    let vertex = |i: u32, j: u32| i * around + j % around;
    for i in 0..rings {
        for j in 0..around {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            if i + 1 < rings {
                mesh.triangles.push([a, b, c]);
            }
            if i > 0 {
                mesh.triangles.push([a, c, d]);
            }
        }
    }
    mesh
}

/// A box of triangles with the given corners, faces outward.
pub(crate) fn box_mesh(min: Vec3, max: Vec3) -> TriMesh {
    let positions: Vec<Vec3> = (0..8)
        .map(|i| {
            let pick = |bit, a: f32, b: f32| if i & bit == 0 { a } else { b };
            Vec3::new(pick(1, min.x, max.x), pick(2, min.y, max.y), pick(4, min.z, max.z))
        })
        .collect();
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriMesh { positions, triangles, ..TriMesh::default() }
}
