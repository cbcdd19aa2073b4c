//! Writing files: old or whole, with the right permissions, through links, and into streams.

use heliostat_io::SaveError;
use heliostat_io::atomic::write_atomically;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

fn put(path: &Path, text: &str) -> Result<(), SaveError> {
    write_atomically(path, |out| out.write_all(text.as_bytes()))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let name = |e: io::Result<fs::DirEntry>| e.expect("an entry").file_name().to_string_lossy().into_owned();
    let mut names: Vec<_> = entries.map(name).collect();
    names.sort();
    names
}

#[test]
fn a_file_is_new_or_replaced_and_nothing_else_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.exr");
    put(&path, "one").unwrap();
    put(&path, "two").unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "two");
    assert_eq!(names(folder.path()), ["picture.exr"]);
}

#[test]
fn a_failed_write_leaves_the_old_file_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    put(&path, "old").unwrap();
    let failing = |out: &mut dyn Write| {
        out.write_all(b"half of it")?;
        Err(io::Error::from(io::ErrorKind::StorageFull))
    };
    let error = write_atomically(&path, failing).unwrap_err();
    assert!(error.to_string().ends_with("no space left; free some space, or choose another disk"), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(names(folder.path()), ["a"]);
}

#[test]
fn a_bare_name_lands_in_the_working_folder() {
    // The working folder of a test is its package.
    let name = Path::new("atomic-test-bare-name.tmp");
    put(name, "here").unwrap();
    let content = fs::read_to_string(name);
    fs::remove_file(name).unwrap();
    assert_eq!(content.unwrap(), "here");
}

#[test]
fn missing_folders_and_folders_as_files_are_named_with_a_mend() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no/such/a.png");
    let error = put(&missing, "x").unwrap_err().to_string();
    assert!(error.starts_with(missing.to_str().unwrap()) && error.contains("mkdir -p"), "{error}");
    let error = put(folder.path(), "x").unwrap_err().to_string();
    assert!(error.contains("is a folder"), "{error}");
    let slash = format!("{}/new/", folder.path().display());
    assert!(put(Path::new(&slash), "x").is_err());
    let file = folder.path().join("file");
    put(&file, "x").unwrap();
    let error = put(&file.join("below"), "x").unwrap_err().to_string();
    assert!(error.contains("is not a folder"), "{error}");
    let long = folder.path().join("x".repeat(300));
    assert!(put(&long, "x").is_err());
    assert_eq!(names(folder.path()), ["file"]);
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).expect("a file").permissions().mode() & 0o7777
    }

    #[test]
    fn new_files_follow_the_umask() {
        let folder = tempfile::tempdir().unwrap();
        let [plain, ours] = ["plain", "ours"].map(|n| folder.path().join(n));
        fs::write(&plain, "x").unwrap();
        put(&ours, "x").unwrap();
        assert_eq!(mode(&ours), mode(&plain));
    }

    #[test]
    fn replaced_files_keep_their_permissions() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        put(&path, "x").unwrap();
        for bits in [0o600, 0o640, 0o664, 0o755] {
            fs::set_permissions(&path, fs::Permissions::from_mode(bits)).unwrap();
            put(&path, "y").unwrap();
            assert_eq!(mode(&path), bits);
        }
    }

    #[test]
    fn links_stay_and_their_targets_are_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        fs::create_dir(&inner).unwrap();
        let [first, second] = ["first", "second"].map(|n| folder.path().join(n));
        symlink("second", &first).unwrap();
        symlink("inner/target", &second).unwrap();
        for text in ["through a dangling link", "through a link to a file"] {
            put(&first, text).unwrap();
            assert!(fs::symlink_metadata(&first).unwrap().is_symlink());
            assert_eq!(fs::read_to_string(inner.join("target")).unwrap(), text);
        }
        assert_eq!(names(&inner), ["target"]);
        let circle = folder.path().join("circle");
        symlink("circle", &circle).unwrap();
        assert!(put(&circle, "x").unwrap_err().to_string().contains("symbolic links"));
    }

    #[test]
    fn write_protected_files_are_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        put(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        if fs::OpenOptions::new().write(true).open(&path).is_ok() {
            return; // This user may write everything.
        }
        let error = put(&path, "new").unwrap_err().to_string();
        assert!(error.contains("permission to write denied"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    }

    #[test]
    fn devices_and_pipes_are_written_directly() {
        put(Path::new("/dev/null"), "x").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
        let error = put(Path::new("/dev/full"), "x");
        if Path::new("/dev/full").exists() {
            assert!(error.unwrap_err().to_string().contains("no space left"));
        }
    }
}
