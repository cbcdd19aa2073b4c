//! The C interface of the library: the only place of the project, besides the lanes of the index, with `unsafe`.
//!
//! Pixels are copied into buffers that the library owns and out of them again, so it never holds a pointer of ours after
//! a call.

#![expect(unsafe_code, reason = "a foreign library is called through its C interface")]

use crate::Picture;
use crate::error::OidnError;
use libloading::Library;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::mem::ManuallyDrop;
use std::path::Path;
use std::ptr;

/// A pointer to something that the library owns: `OIDNDevice`, `OIDNBuffer` or `OIDNFilter`.
type Handle = *mut c_void;

/// `OIDN_DEVICE_TYPE_CPU`: the same picture on every machine, as near as the library can.
const CPU: c_int = 1;
/// `OIDN_FORMAT_FLOAT3`.
const FLOAT3: c_int = 3;
/// `OIDN_ERROR_NONE`.
const NO_ERROR: c_int = 0;

/// Declares the functions of the library that are called, by their names there, and a way to look them all up.
macro_rules! functions {
    ($($field:ident = $name:literal: fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// The functions of `oidn.h` that are called.
        #[derive(Clone, Copy)]
        struct Functions {
            $($field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
        }

        impl Functions {
            fn of(library: &Library, path: &Path) -> Result<Self, OidnError> {
                let missing = |function| OidnError::Incomplete { path: path.to_owned(), function };
                Ok(Self {
                    $($field: {
                        // SAFETY: the type is that of the function of this name in oidn.h, version 2.
                        let symbol = unsafe { library.get(concat!($name, "\0").as_bytes()) };
                        *symbol.map_err(|_| missing($name))?
                    },)*
                })
            }
        }
    };
}

functions! {
    new_device = "oidnNewDevice": fn(c_int) -> Handle;
    set_device_int = "oidnSetDeviceInt": fn(Handle, *const c_char, c_int);
    set_device_bool = "oidnSetDeviceBool": fn(Handle, *const c_char, bool);
    get_device_int = "oidnGetDeviceInt": fn(Handle, *const c_char) -> c_int;
    get_device_error = "oidnGetDeviceError": fn(Handle, *mut *const c_char) -> c_int;
    commit_device = "oidnCommitDevice": fn(Handle);
    release_device = "oidnReleaseDevice": fn(Handle);
    new_buffer = "oidnNewBuffer": fn(Handle, usize) -> Handle;
    read_buffer = "oidnReadBuffer": fn(Handle, usize, usize, *mut c_void);
    write_buffer = "oidnWriteBuffer": fn(Handle, usize, usize, *const c_void);
    release_buffer = "oidnReleaseBuffer": fn(Handle);
    new_filter = "oidnNewFilter": fn(Handle, *const c_char) -> Handle;
    set_filter_image = "oidnSetFilterImage": fn(Handle, *const c_char, Handle, c_int, usize, usize, usize, usize, usize);
    set_filter_bool = "oidnSetFilterBool": fn(Handle, *const c_char, bool);
    commit_filter = "oidnCommitFilter": fn(Handle);
    execute_filter = "oidnExecuteFilter": fn(Handle);
    release_filter = "oidnReleaseFilter": fn(Handle);
}

/// The library and its functions.
pub(crate) struct Native {
    functions: Functions,
    /// Never unloaded: threads of the library may outlive the last call.
    _library: ManuallyDrop<Library>,
}

impl std::fmt::Debug for Native {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Native").finish_non_exhaustive()
    }
}

impl Native {
    /// Opens a library and looks up all functions.
    pub(crate) fn open(path: &Path) -> Result<Self, OidnError> {
        // SAFETY: opening runs what the library runs at its start. The file is the one that the user named, or the
        // system's under the name of Open Image Denoise, whose start does nothing that Rust could notice.
        let library = unsafe { Library::new(path) };
        let library = library
            .map_err(|error| OidnError::CannotOpen { path: path.to_owned(), cause: error.to_string() })?;
        let library = ManuallyDrop::new(library);
        Ok(Self { functions: Functions::of(&library, path)?, _library: library })
    }

    /// 10000 times the first number of the version, 100 times the second, and the third.
    pub(crate) fn version(&self) -> Result<i32, OidnError> {
        let device = Device::new(&self.functions, 1)?;
        // SAFETY: the device lives, and the name ends with a zero.
        Ok(unsafe { (self.functions.get_device_int)(device.handle, c"version".as_ptr()) })
    }

    /// Runs the filter for ray traced pictures over one picture, whose images have three floats per pixel.
    pub(crate) fn denoise(&self, picture: &Picture<'_>, threads: usize) -> Result<Vec<f32>, OidnError> {
        let device = Device::new(&self.functions, threads)?;
        let filter = Filter::new(&device)?;
        let size = (picture.width, picture.height);
        let mut inputs = vec![(c"color", picture.color)];
        inputs.extend(picture.albedo.map(|albedo| (c"albedo", albedo)));
        // The library refuses normals that come without albedo.
        inputs.extend(picture.normal.filter(|_| picture.albedo.is_some()).map(|normal| (c"normal", normal)));
        let mut buffers = Vec::new();
        for (name, values) in inputs {
            let buffer = Buffer::new(&device, values.len())?;
            buffer.write(values);
            filter.image(name, &buffer, size);
            buffers.push(buffer);
        }
        let output = Buffer::new(&device, picture.color.len())?;
        filter.image(c"output", &output, size);
        filter.run_hdr();
        device.check()?;
        let clean = output.read();
        device.check()?;
        Ok(clean)
    }
}

/// A device, released in the end.
struct Device<'a> {
    functions: &'a Functions,
    handle: Handle,
}

impl<'a> Device<'a> {
    /// The processor, with so many threads; 0 leaves it to the library.
    fn new(functions: &'a Functions, threads: usize) -> Result<Self, OidnError> {
        // SAFETY: no pointers are handed over; null is looked for.
        let handle = unsafe { (functions.new_device)(CPU) };
        let device = Self { functions, handle };
        if handle.is_null() {
            return Err(device.error().unwrap_or_else(no_reason));
        }
        let threads = c_int::try_from(threads).unwrap_or(c_int::MAX);
        // SAFETY: the device lives, and the names end with a zero.
        unsafe {
            (functions.set_device_int)(handle, c"numThreads".as_ptr(), threads);
            // Threads stay where the system puts them: others may work on this machine.
            (functions.set_device_bool)(handle, c"setAffinity".as_ptr(), false);
            (functions.commit_device)(handle);
        }
        device.check()?;
        Ok(device)
    }

    /// The first error since the last question.
    fn check(&self) -> Result<(), OidnError> {
        self.error().map_or(Ok(()), Err)
    }

    fn error(&self) -> Option<OidnError> {
        let mut words = ptr::null();
        // SAFETY: the device lives or is null, which asks why there is none; `words` is written before the call returns.
        let code = unsafe { (self.functions.get_device_error)(self.handle, &raw mut words) };
        if code == NO_ERROR {
            return None;
        }
        let message = if words.is_null() {
            "no reason given".to_owned()
        } else {
            // SAFETY: a text that ends with a zero and lives until the next call for this device; it is copied here.
            unsafe { CStr::from_ptr(words) }.to_string_lossy().into_owned()
        };
        Some(OidnError::Refused { code, message })
    }
}

impl Drop for Device<'_> {
    fn drop(&mut self) {
        if !self.handle.is_null() {
            // SAFETY: the handle is ours, and nothing uses it after this.
            unsafe { (self.functions.release_device)(self.handle) }
        }
    }
}

/// Floats that the library owns, released in the end.
struct Buffer<'a> {
    device: &'a Device<'a>,
    handle: Handle,
    floats: usize,
}

impl<'a> Buffer<'a> {
    fn new(device: &'a Device<'a>, floats: usize) -> Result<Self, OidnError> {
        // SAFETY: the device lives; null is looked for. A slice of floats has fewer bytes than `usize` can count.
        let handle = unsafe { (device.functions.new_buffer)(device.handle, size_of::<f32>() * floats) };
        device.check()?;
        if handle.is_null() { Err(no_reason()) } else { Ok(Self { device, handle, floats }) }
    }

    fn bytes(&self) -> usize {
        size_of::<f32>() * self.floats
    }

    /// # Panics
    /// When there are more or fewer values than the buffer holds.
    fn write(&self, values: &[f32]) {
        assert_eq!(values.len(), self.floats, "a buffer is filled whole");
        // SAFETY: the buffer lives, both hold as many bytes, and the library has read them when the call returns.
        unsafe {
            (self.device.functions.write_buffer)(self.handle, 0, self.bytes(), values.as_ptr().cast());
        }
    }

    fn read(&self) -> Vec<f32> {
        let mut values = vec![0.0_f32; self.floats];
        // SAFETY: the buffer lives, both hold as many bytes, and the library has written them when the call returns.
        unsafe {
            (self.device.functions.read_buffer)(self.handle, 0, self.bytes(), values.as_mut_ptr().cast());
        }
        values
    }
}

impl Drop for Buffer<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is ours, and nothing uses it after this; filters keep their own count of it.
        unsafe { (self.device.functions.release_buffer)(self.handle) }
    }
}

/// The filter for ray traced pictures, released in the end.
struct Filter<'a> {
    device: &'a Device<'a>,
    handle: Handle,
}

impl<'a> Filter<'a> {
    fn new(device: &'a Device<'a>) -> Result<Self, OidnError> {
        // SAFETY: the device lives, the name ends with a zero; null is looked for.
        let handle = unsafe { (device.functions.new_filter)(device.handle, c"RT".as_ptr()) };
        device.check()?;
        if handle.is_null() { Err(no_reason()) } else { Ok(Self { device, handle }) }
    }

    /// Hands over an image without gaps between pixels or rows.
    fn image(&self, name: &CStr, buffer: &Buffer<'_>, (width, height): (usize, usize)) {
        let (functions, pixels) = (self.device.functions, buffer.handle);
        // SAFETY: filter and buffer live and belong to one device; the library checks the size against the buffer.
        unsafe {
            (functions.set_filter_image)(self.handle, name.as_ptr(), pixels, FLOAT3, width, height, 0, 0, 0);
        }
    }

    /// Runs it over light of any brightness, and waits for it.
    fn run_hdr(&self) {
        let functions = self.device.functions;
        // SAFETY: the filter lives, the name ends with a zero; what is missing becomes an error of the device.
        unsafe {
            (functions.set_filter_bool)(self.handle, c"hdr".as_ptr(), true);
            (functions.commit_filter)(self.handle);
            (functions.execute_filter)(self.handle);
        }
    }
}

impl Drop for Filter<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is ours, and nothing uses it after this.
        unsafe { (self.device.functions.release_filter)(self.handle) }
    }
}

/// For handles that are null although no error is told.
fn no_reason() -> OidnError {
    OidnError::Refused { code: NO_ERROR, message: "gave nothing, and no reason".to_owned() }
}
