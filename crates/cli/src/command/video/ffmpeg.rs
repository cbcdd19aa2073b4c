//! The ffmpeg process: raw frames in, H.264 out, written beside the target and renamed.
//!
//! # Source
//! The ffmpeg manual, `rawvideo` and `libx264`; players expect `yuv420p`, even sizes, BT.709 tags and the index at the
//! front (`+faststart`).

use super::raster::Raster;
use crate::diagnose::Failure;
use crate::exit::Exit;
use heliostat_io::SaveError;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;
use tempfile::{NamedTempFile, TempPath};

/// Pads to even sizes, then converts with the matrix that the tags name.
const FILTER: &str = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";

/// A running ffmpeg. Dropped before [`Encoder::finish`], it leaves no file behind.
#[derive(Debug)]
pub(super) struct Encoder {
    child: Child,
    input: Option<ChildStdin>,
    /// What it says; read while it runs, or it would wait for a reader.
    complaints: Option<JoinHandle<String>>,
    temporary: Option<TempPath>,
}

impl Drop for Encoder {
    fn drop(&mut self) {
        // Of a process that has ended, neither has anything to do.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Encoder {
    /// Starts ffmpeg for frames of the size of `first`.
    pub(super) fn start(output: &Path, first: &Raster, fps: f64, crf: u8) -> Result<Self, Failure> {
        let temporary = temporary(output).map_err(|e| SaveError::io(output, e))?;
        let mut child = Command::new("ffmpeg")
            .args(["-hide_banner", "-nostdin", "-loglevel", "error", "-y"])
            .args(["-f", "rawvideo", "-pix_fmt", "rgb24"])
            .args(["-video_size", &format!("{}x{}", first.width, first.height)])
            .args(["-framerate", &fps.to_string(), "-i", "pipe:0"])
            .args(["-vf", FILTER, "-c:v", "libx264", "-crf", &crf.to_string()])
            .args(["-color_primaries", "bt709", "-color_trc", "bt709", "-colorspace", "bt709"])
            .args(["-movflags", "+faststart"])
            .arg(&temporary)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|e| cannot_start(&e))?;
        let input = child.stdin.take();
        let errors = child.stderr.take();
        let complaints = Some(std::thread::spawn(move || read_all(errors)));
        Ok(Self { child, input, complaints, temporary: Some(temporary) })
    }

    /// Hands it the next frame.
    ///
    /// # Errors
    /// When ffmpeg has ended; [`Encoder::finish`] tells why.
    pub(super) fn write(&mut self, raster: &Raster) -> io::Result<()> {
        self.input.as_mut().map_or(Ok(()), |input| input.write_all(&raster.rgb))
    }

    /// Waits for the end and puts the video in place.
    pub(super) fn finish(mut self, output: &Path) -> Result<(), Failure> {
        // Closing the pipe says that there are no more frames.
        drop(self.input.take());
        let status = self.child.wait().map_err(|e| cannot_start(&e))?;
        let complaints = self.complaints.take().and_then(|c| c.join().ok()).unwrap_or_default();
        if !status.success() {
            return Err(Failure::new(Exit::Failed, format!("ffmpeg failed: {}", short(&complaints))));
        }
        let Some(temporary) = self.temporary.take() else { return Ok(()) };
        let sync = std::fs::File::open(&temporary).and_then(|file| file.sync_all());
        let moved = sync.and_then(|()| temporary.persist(output).map_err(|e| e.error));
        moved.map_err(|e| SaveError::io(output, e).into())
    }
}

/// An empty file beside `output` with its ending, readable by whom the umask lets.
fn temporary(output: &Path) -> io::Result<TempPath> {
    let folder = output.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let ending = output.extension().unwrap_or_default().to_string_lossy();
    let suffix = format!(".{ending}");
    let mut builder = tempfile::Builder::new();
    builder.prefix(".heliostat-").suffix(&suffix);
    #[cfg(unix)]
    let builder = builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder).map(NamedTempFile::into_temp_path)
}

fn cannot_start(error: &io::Error) -> Failure {
    let line = match error.kind() {
        io::ErrorKind::NotFound => {
            "ffmpeg was not found on the PATH; install it (https://ffmpeg.org, or the package `ffmpeg`)"
                .to_owned()
        }
        _ => format!("ffmpeg cannot be run: {error}; check its installation with `ffmpeg -version`"),
    };
    Failure::new(Exit::Failed, line)
}

fn read_all(from: Option<impl Read>) -> String {
    let mut bytes = Vec::new();
    // What was read before an error is still worth telling.
    let _ = from.map(|mut from| from.read_to_end(&mut bytes));
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The first line of what ffmpeg says: the others follow from it.
fn short(complaints: &str) -> String {
    const LONGEST: usize = 200;
    let line = complaints.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("no reason given");
    line.chars().take(LONGEST).collect()
}
