//! The C interface of Open Image Denoise 2, loaded at run time. All that is unsafe of it is here:
//! the signatures are those of `oidn.h`, and pointers to images are made of slices alone.

#![expect(unsafe_code, reason = "these are functions of a C library that is loaded at run time")]

use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::{self, NonNull};

use libloading::Library;

use super::error::DenoiseError;
use super::places;

/// A device or a filter.
type Handle = *mut c_void;

/// `OIDN_DEVICE_TYPE_CPU`: the same bytes on every run, which no GPU promises.
const CPU: c_int = 1;
/// `OIDN_FORMAT_FLOAT3`.
const FLOAT3: c_int = 3;
/// `OIDN_ERROR_NONE`.
const NO_ERROR: c_int = 0;

/// The functions that are called.
#[derive(Debug, Clone, Copy)]
struct Functions {
    new_device: unsafe extern "C" fn(c_int) -> Handle,
    set_device_int: unsafe extern "C" fn(Handle, *const c_char, c_int),
    get_device_int: unsafe extern "C" fn(Handle, *const c_char) -> c_int,
    commit_device: unsafe extern "C" fn(Handle),
    get_device_error: unsafe extern "C" fn(Handle, *mut *const c_char) -> c_int,
    release_device: unsafe extern "C" fn(Handle),
    new_filter: unsafe extern "C" fn(Handle, *const c_char) -> Handle,
    set_filter_image: SetFilterImage,
    set_filter_bool: unsafe extern "C" fn(Handle, *const c_char, bool),
    commit_filter: unsafe extern "C" fn(Handle),
    execute_filter: unsafe extern "C" fn(Handle),
    release_filter: unsafe extern "C" fn(Handle),
}

/// Filter, name, pixels, format, width, height, offset, bytes of a pixel and of a row (0: packed).
type SetFilterImage = unsafe extern "C" fn(
    Handle,
    *const c_char,
    *mut c_void,
    c_int,
    usize,
    usize,
    usize,
    usize,
    usize,
);

impl Functions {
    /// Loads a library and looks its functions up.
    fn load(file: &Path) -> Result<Self, String> {
        // SAFETY: loading a library runs its initialisers. Those of Open Image Denoise may run at
        // any time; that the file is that library is what the user, or the system, says by its name.
        let library = unsafe { Library::new(file) }.map_err(|error| error.to_string())?;
        // SAFETY: the signatures are those that `oidn.h` of version 2 declares for these names.
        let functions = unsafe { Self::of(&library) }
            .map_err(|error| format!("{} is not it: {error}", file.display()))?;
        // Threads of the library may outlive its devices: it stays loaded until the program ends.
        // So the functions may be called whenever they are there.
        std::mem::forget(library);
        Ok(functions)
    }

    /// # Safety
    /// The library's functions have the signatures that the fields have.
    unsafe fn of(library: &Library) -> Result<Self, libloading::Error> {
        // SAFETY: as above; a pointer to a function is copied out, and is used while the library is loaded.
        unsafe {
            Ok(Self {
                new_device: *library.get(b"oidnNewDevice\0")?,
                set_device_int: *library.get(b"oidnSetDeviceInt\0")?,
                get_device_int: *library.get(b"oidnGetDeviceInt\0")?,
                commit_device: *library.get(b"oidnCommitDevice\0")?,
                get_device_error: *library.get(b"oidnGetDeviceError\0")?,
                release_device: *library.get(b"oidnReleaseDevice\0")?,
                new_filter: *library.get(b"oidnNewFilter\0")?,
                set_filter_image: *library.get(b"oidnSetSharedFilterImage\0")?,
                set_filter_bool: *library.get(b"oidnSetFilterBool\0")?,
                commit_filter: *library.get(b"oidnCommitFilter\0")?,
                execute_filter: *library.get(b"oidnExecuteFilter\0")?,
                release_filter: *library.get(b"oidnReleaseFilter\0")?,
            })
        }
    }

    /// The first error since this was last asked, of a device; of its making where there is none.
    fn error(&self, device: Handle) -> Option<String> {
        let mut message = ptr::null();
        // SAFETY: the device is null, as may be here, or one that is not released yet.
        let code = unsafe { (self.get_device_error)(device, &raw mut message) };
        if code == NO_ERROR {
            return None;
        }
        if message.is_null() {
            return Some(format!("error {code}"));
        }
        // SAFETY: a C string that is valid until the function is called again, which needs `self`
        // on this thread; it is copied at once.
        Some(unsafe { CStr::from_ptr(message) }.to_string_lossy().into_owned())
    }
}

/// The library with a device of its own: the CPU.
#[derive(Debug)]
pub struct Device {
    functions: Functions,
    handle: NonNull<c_void>,
}

/// What a filter works on: images of the same size, row by row.
#[derive(Debug, Clone, Copy)]
pub struct Inputs<'a> {
    /// Pixels in a row, and rows.
    pub size: [usize; 2],
    /// Linear radiance from 0, with noise.
    pub color: &'a [[f32; 3]],
    /// What surfaces reflect, in [0, 1].
    pub albedo: &'a [[f32; 3]],
    /// Their normals, of length 1 or shorter.
    pub normal: &'a [[f32; 3]],
    /// Whether albedo and normals have no noise worth removing.
    pub clean: bool,
}

impl Device {
    /// Loads the library from the first place that has it, for so many threads.
    ///
    /// # Errors
    /// It is in none, or cannot be used on this machine.
    pub fn open(threads: usize) -> Result<Self, DenoiseError> {
        let files = places::candidates().map_err(|e| DenoiseError::Missing(e.to_string()))?;
        let mut first = None;
        for file in files {
            match Functions::load(&file) {
                Ok(functions) => return Self::new(functions, threads),
                Err(why) => first = first.or(Some(why)),
            }
        }
        Err(DenoiseError::Missing(first.unwrap_or_default()))
    }

    fn new(functions: Functions, threads: usize) -> Result<Self, DenoiseError> {
        // SAFETY: takes a number.
        let handle = unsafe { (functions.new_device)(CPU) };
        let Some(handle) = NonNull::new(handle) else {
            let why = functions.error(ptr::null_mut()).unwrap_or_else(|| "no CPU device".into());
            return Err(DenoiseError::Failed(why));
        };
        let device = Self { functions, handle };
        let threads = c_int::try_from(threads).unwrap_or(c_int::MAX);
        // SAFETY: the handle is of a device, and the name a C string that is read at once.
        unsafe {
            (functions.set_device_int)(handle.as_ptr(), c"numThreads".as_ptr(), threads);
            (functions.commit_device)(handle.as_ptr());
        }
        device.check()?;
        Ok(device)
    }

    /// Major, minor and patch, such as 2.5.1.
    pub fn version(&self) -> String {
        // SAFETY: the handle is of a device, and the names are C strings that are read at once.
        let [major, minor, patch] =
            [c"versionMajor", c"versionMinor", c"versionPatch"].map(|name| unsafe {
                (self.functions.get_device_int)(self.handle.as_ptr(), name.as_ptr())
            });
        format!("{major}.{minor}.{patch}")
    }

    /// The colours without their noise.
    ///
    /// # Errors
    /// The library fails, or runs out of memory.
    pub fn denoise(&self, inputs: &Inputs<'_>) -> Result<Vec<[f32; 3]>, DenoiseError> {
        let Inputs { size, color, albedo, normal, clean } = *inputs;
        let mut output = vec![[0.0; 3]; color.len()];
        let filter = Filter::new(self, size)?;
        filter.set(c"hdr", true);
        filter.set(c"cleanAux", clean);
        filter.set_input(c"color", color)?;
        filter.set_input(c"albedo", albedo)?;
        filter.set_input(c"normal", normal)?;
        filter.run(&mut output)?;
        Ok(output)
    }

    fn check(&self) -> Result<(), DenoiseError> {
        match self.functions.error(self.handle.as_ptr()) {
            Some(why) => Err(DenoiseError::Failed(why)),
            None => Ok(()),
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: the handle is of a device; its filters, which borrow it, are gone.
        unsafe { (self.functions.release_device)(self.handle.as_ptr()) }
    }
}

/// A filter for ray-traced images. It borrows its inputs, so that they outlive it.
struct Filter<'a> {
    device: &'a Device,
    handle: NonNull<c_void>,
    size: [usize; 2],
}

impl<'a> Filter<'a> {
    fn new(device: &'a Device, size: [usize; 2]) -> Result<Self, DenoiseError> {
        let functions = &device.functions;
        // SAFETY: the handle is of a device, and the type a C string that is read at once.
        let handle = unsafe { (functions.new_filter)(device.handle.as_ptr(), c"RT".as_ptr()) };
        device.check()?;
        let handle = NonNull::new(handle)
            .ok_or_else(|| DenoiseError::Failed("there is no filter RT".to_owned()))?;
        Ok(Self { device, handle, size })
    }

    fn set(&self, name: &CStr, value: bool) {
        // SAFETY: the handle is of a filter, and the name a C string that is read at once.
        unsafe {
            (self.device.functions.set_filter_bool)(self.handle.as_ptr(), name.as_ptr(), value);
        }
    }

    fn set_input(&self, name: &CStr, pixels: &'a [[f32; 3]]) -> Result<(), DenoiseError> {
        // SAFETY: the library reads its inputs and does not write them; they outlive the filter.
        unsafe { self.set_image(name, pixels.as_ptr().cast_mut(), pixels.len()) }
    }

    /// # Safety
    /// The pixels may be read, and those of the output written, until the filter is released.
    unsafe fn set_image(
        &self,
        name: &CStr,
        pixels: *mut [f32; 3],
        count: usize,
    ) -> Result<(), DenoiseError> {
        let [width, height] = self.size;
        if width.checked_mul(height) != Some(count) {
            return Err(DenoiseError::Failed(format!("{count} pixels are not {width} × {height}")));
        }
        // SAFETY: the handle is of a filter, the name a C string that is read at once; the image
        // is packed, and has as many pixels as width and height say.
        unsafe {
            (self.device.functions.set_filter_image)(
                self.handle.as_ptr(),
                name.as_ptr(),
                pixels.cast(),
                FLOAT3,
                width,
                height,
                0,
                0,
                0,
            );
        }
        self.device.check()
    }

    /// Filters the inputs into an image. The filter ends with it, so that it cannot write to
    /// pixels that are borrowed no more.
    fn run(self, output: &mut [[f32; 3]]) -> Result<(), DenoiseError> {
        let functions = &self.device.functions;
        // SAFETY: the pixels are borrowed until the filter is released, at the end of this.
        unsafe { self.set_image(c"output", output.as_mut_ptr(), output.len())? };
        // SAFETY: the handle is of a filter, whose images are all alive.
        unsafe { (functions.commit_filter)(self.handle.as_ptr()) };
        self.device.check()?;
        // SAFETY: as above; the filter is committed. On a CPU it is done when this returns.
        unsafe { (functions.execute_filter)(self.handle.as_ptr()) };
        self.device.check()
    }
}

impl Drop for Filter<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is of a filter, and is not used again.
        unsafe { (self.device.functions.release_filter)(self.handle.as_ptr()) }
    }
}
