//! Memory of this process as the system counts it: Linux only, `None` elsewhere.
//!
//! # Source
//! `man 5 proc_pid_status`: `VmRSS` is the resident set, `VmHWM` its peak, both in kB of 1024 bytes.

/// Bytes of memory in use now.
pub(crate) fn resident() -> Option<u64> {
    status("VmRSS:")
}

/// The most bytes of memory that were ever in use.
pub(crate) fn peak() -> Option<u64> {
    status("VmHWM:")
}

fn status(key: &str) -> Option<u64> {
    if !cfg!(target_os = "linux") {
        return None;
    }
    entry(&std::fs::read_to_string("/proc/self/status").ok()?, key)
}

fn entry(status: &str, key: &str) -> Option<u64> {
    let line = status.lines().find_map(|l| l.strip_prefix(key))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kilobytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_entry_of_proc_status() {
        let text = "Name:\tx\nVmHWM:\t    2048 kB\nVmRSS:\t    1024 kB\n";
        assert_eq!(entry(text, "VmHWM:"), Some(2048 * 1024));
        assert_eq!(entry(text, "VmRSS:"), Some(1024 * 1024));
        assert_eq!(entry(text, "VmSwap:"), None);
        assert_eq!(entry("VmRSS:\tmuch", "VmRSS:"), None);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn peak_is_at_least_what_is_resident() {
        let now = resident().expect("Linux tells it");
        assert!(peak().expect("Linux tells it") >= now / 2);
    }
}
