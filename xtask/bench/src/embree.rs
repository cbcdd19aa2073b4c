//! Embree 4, found at run time by a path: as much of its C interface as tracing single rays takes.
//!
//! # Source
//! Embree 4 API reference, `rtcIntersect1`, `rtcOccluded1`, and the layouts of `RTCRay` and `RTCHit`.

#![expect(unsafe_code, reason = "a foreign library is called through its C interface")]

use crate::contestant::{Contestant, Query};
use heliostat_geometry::{Ray, TriMesh};
use libloading::{Library, Symbol};
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::path::Path;
use std::rc::Rc;
use std::time::Instant;

const INDEX_BUFFER: c_int = 0;
const VERTEX_BUFFER: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;
const TRIANGLES: c_int = 0;
const QUALITY_HIGH: c_int = 2;
const ROBUST: c_int = 1 << 2;
const INVALID: u32 = u32::MAX;

type Handle = *mut c_void;

/// `RTCRay`.
#[repr(C, align(16))]
#[derive(Clone, Copy)]
struct RtcRay {
    origin: [f32; 3],
    near: f32,
    dir: [f32; 3],
    time: f32,
    far: f32,
    mask: c_uint,
    id: c_uint,
    flags: c_uint,
}

/// `RTCRayHit`.
#[repr(C, align(16))]
struct RtcRayHit {
    ray: RtcRay,
    normal: [f32; 3],
    uv: [f32; 2],
    primitive: c_uint,
    geometry: c_uint,
    instance: [c_uint; 2],
    /// Room to spare past what any version writes.
    spare: [c_uint; 16],
}

impl From<&Ray> for RtcRay {
    #[inline(always)]
    fn from(ray: &Ray) -> Self {
        Self {
            origin: ray.origin.to_array(),
            near: ray.range.min,
            dir: ray.dir.to_array(),
            time: 0.0,
            far: ray.range.max,
            mask: u32::MAX,
            id: 0,
            flags: 0,
        }
    }
}

type Intersect = unsafe extern "C" fn(Handle, *mut RtcRayHit, *mut c_void);
type Occluded = unsafe extern "C" fn(Handle, *mut RtcRay, *mut c_void);

/// The library with one device.
pub(crate) struct Embree {
    library: Library,
    device: Handle,
}

impl Embree {
    /// Opens the library, with a device of so many build threads; `config` is added to the device's settings.
    pub(crate) fn open(path: &Path, threads: usize, config: &str) -> Result<Rc<Self>, String> {
        let failed = |e: libloading::Error| format!("{}: {e}", path.display());
        // SAFETY: the user names a library that they trust to be Embree.
        let library = unsafe { Library::new(path) }.map_err(failed)?;
        let settings = CString::new(format!("threads={threads}{config}")).map_err(|e| e.to_string())?;
        // SAFETY: the signature is that of Embree 4.
        let device = unsafe {
            let new: Symbol<'_, unsafe extern "C" fn(*const c_char) -> Handle> =
                library.get(b"rtcNewDevice").map_err(failed)?;
            new(settings.as_ptr())
        };
        if device.is_null() {
            return Err(format!("{}: Embree makes no device", path.display()));
        }
        let embree = Rc::new(Self { library, device });
        // It is never unloaded: its threads do not like that.
        std::mem::forget(Rc::clone(&embree));
        Ok(embree)
    }

    /// A function of the library.
    ///
    /// # Safety
    /// `F` must be the type of that function.
    unsafe fn function<F: Copy>(&self, name: &str) -> Result<F, String> {
        // SAFETY: the caller knows the type.
        let symbol = unsafe { self.library.get::<F>(name.as_bytes()) };
        symbol.map(|symbol| *symbol).map_err(|e| format!("{name}: {e}"))
    }
}

/// A mesh in an Embree scene of high build quality.
pub(crate) struct EmbreeScene {
    /// Keeps the functions loaded.
    _embree: Rc<Embree>,
    name: String,
    scene: Handle,
    intersect: Intersect,
    occluded: Occluded,
    build_seconds: f64,
}

impl EmbreeScene {
    /// Builds the scene.
    pub(crate) fn build(embree: &Rc<Embree>, mesh: &TriMesh, robust: bool) -> Result<Self, String> {
        type MakeBuffer = unsafe extern "C" fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void;
        type Make = unsafe extern "C" fn(Handle) -> Handle;
        type Set = unsafe extern "C" fn(Handle, c_int);
        type Do = unsafe extern "C" fn(Handle);
        // SAFETY: types and call order are those of the Embree 4 reference; buffers are filled within their size.
        unsafe {
            let new_scene: Make = embree.function("rtcNewScene")?;
            let new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle =
                embree.function("rtcNewGeometry")?;
            let make_buffer: MakeBuffer = embree.function("rtcSetNewGeometryBuffer")?;
            let set_scene_quality: Set = embree.function("rtcSetSceneBuildQuality")?;
            let set_geometry_quality: Set = embree.function("rtcSetGeometryBuildQuality")?;
            let set_flags: Set = embree.function("rtcSetSceneFlags")?;
            let commit_geometry: Do = embree.function("rtcCommitGeometry")?;
            let commit_scene: Do = embree.function("rtcCommitScene")?;
            let release_geometry: Do = embree.function("rtcReleaseGeometry")?;
            let attach: unsafe extern "C" fn(Handle, Handle) -> c_uint =
                embree.function("rtcAttachGeometry")?;

            let scene = new_scene(embree.device);
            set_scene_quality(scene, QUALITY_HIGH);
            set_flags(scene, if robust { ROBUST } else { 0 });
            let geometry = new_geometry(embree.device, TRIANGLES);
            set_geometry_quality(geometry, QUALITY_HIGH);
            let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
            let to = make_buffer(geometry, VERTEX_BUFFER, 0, FORMAT_FLOAT3, 12, vertices);
            std::ptr::copy_nonoverlapping(mesh.positions.as_ptr().cast(), to.cast::<[f32; 3]>(), vertices);
            let to = make_buffer(geometry, INDEX_BUFFER, 0, FORMAT_UINT3, 12, triangles);
            std::ptr::copy_nonoverlapping(mesh.triangles.as_ptr(), to.cast::<[u32; 3]>(), triangles);

            let begin = Instant::now();
            commit_geometry(geometry);
            attach(scene, geometry);
            commit_scene(scene);
            let build_seconds = begin.elapsed().as_secs_f64();
            release_geometry(geometry);
            Ok(Self {
                _embree: Rc::clone(embree),
                name: format!("Embree high{}", if robust { ", robust" } else { "" }),
                scene,
                intersect: embree.function("rtcIntersect1")?,
                occluded: embree.function("rtcOccluded1")?,
                build_seconds,
            })
        }
    }
}

impl Contestant for EmbreeScene {
    fn name(&self) -> &str {
        &self.name
    }

    fn build_seconds(&self) -> f64 {
        self.build_seconds
    }

    fn trace(&self, query: Query, rays: &[Ray], distances: &mut [f32]) {
        for (ray, distance) in rays.iter().zip(distances) {
            *distance = match query {
                Query::Closest => self.closest(ray),
                Query::Any => self.any(ray),
            };
        }
    }
}

impl EmbreeScene {
    #[inline(always)]
    fn closest(&self, ray: &Ray) -> f32 {
        let mut hit = RtcRayHit {
            ray: ray.into(),
            normal: [0.0; 3],
            uv: [0.0; 2],
            primitive: INVALID,
            geometry: INVALID,
            instance: [INVALID; 2],
            spare: [0; 16],
        };
        // SAFETY: the scene is committed and the structure has Embree's layout.
        unsafe { (self.intersect)(self.scene, &raw mut hit, std::ptr::null_mut()) };
        if hit.geometry == INVALID { f32::INFINITY } else { hit.ray.far }
    }

    #[inline(always)]
    fn any(&self, ray: &Ray) -> f32 {
        let mut query = RtcRay::from(ray);
        // SAFETY: as above.
        unsafe { (self.occluded)(self.scene, &raw mut query, std::ptr::null_mut()) };
        if query.far < 0.0 { 0.0 } else { f32::INFINITY }
    }
}
