//! The state of an NVIDIA device, by NVML (NVML API reference, Device Queries). The library comes with the driver and is
//! loaded when it is there; whatever it cannot tell is not known.

use super::device::{Device, DeviceState};
use libloading::{Library, Symbol};
use std::ffi::{CString, c_char, c_int, c_uint, c_ulonglong, c_void};

/// PCI's number of NVIDIA.
pub const VENDOR: u32 = 0x10de;

const LIBRARY: &str = if cfg!(windows) { "nvml.dll" } else { "libnvidia-ml.so.1" };

/// `NVML_SUCCESS`
const SUCCESS: c_int = 0;

/// `NVML_CLOCK_GRAPHICS`
const GRAPHICS: c_uint = 0;

/// `NVML_CLOCK_MEM`
const MEMORY: c_uint = 2;

/// `NVML_PERF_POLICY_POWER` and `NVML_PERF_POLICY_THERMAL`.
const POLICIES: [c_uint; 2] = [0, 1];

/// Bits of the reasons for lower clocks, as far as the device did not choose them for idleness nor the user for good.
const REASONS: [(c_ulonglong, &str); 6] = [
    (0x04, "power"),
    (0x08, "hardware slowdown"),
    (0x10, "another device in step"),
    (0x20, "heat"),
    (0x40, "heat (hardware)"),
    (0x80, "power brake"),
];

/// `nvmlDevice_t`
type Handle = *mut c_void;
type Call = unsafe extern "C" fn() -> c_int;
type Find = unsafe extern "C" fn(*const c_char, *mut Handle) -> c_int;
type GetClock = unsafe extern "C" fn(Handle, c_uint, *mut c_uint) -> c_int;
type GetReasons = unsafe extern "C" fn(Handle, *mut c_ulonglong) -> c_int;
type GetViolation = unsafe extern "C" fn(Handle, c_uint, *mut Violation) -> c_int;

/// `nvmlViolationTime_t`
#[repr(C)]
#[derive(Default)]
struct Violation {
    /// When it was read, microseconds.
    reference_us: c_ulonglong,
    /// For how long clocks were held back so far, nanoseconds.
    held_back_ns: c_ulonglong,
}

/// NVML, open, and one device of it.
pub struct Nvml {
    library: Library,
    /// A [`Handle`], kept as a number: NVML may be called from any thread.
    device: usize,
}

impl Nvml {
    /// Opens the library and finds `device` by its UUID, else by its PCI address.
    pub fn open(device: &Device) -> Option<Self> {
        Self::open_as(LIBRARY, device)
    }

    fn open_as(library: &str, device: &Device) -> Option<Self> {
        // SAFETY: the driver's library runs nothing on loading that the driver's Vulkan library does not run too.
        let library = unsafe { Library::new(library) }.ok()?;
        let mut nvml = Self { library, device: 0 };
        nvml.call(b"nvmlInit_v2\0")?;
        let by_uuid = || nvml.find(b"nvmlDeviceGetHandleByUUID\0", &format!("GPU-{}", device.uuid));
        let by_pci = || nvml.find(b"nvmlDeviceGetHandleByPciBusId_v2\0", device.pci.as_deref()?);
        nvml.device = by_uuid().or_else(by_pci)?;
        Some(nvml)
    }

    /// What the device tells now.
    pub fn read(&self) -> DeviceState {
        DeviceState {
            graphics_mhz: self.clock(GRAPHICS),
            memory_mhz: self.clock(MEMORY),
            throttled: self.reasons().map(reason_names).unwrap_or_default(),
            throttled_ns: POLICIES
                .into_iter()
                .filter_map(|policy| self.held_back_ns(policy))
                .reduce(|a, b| a + b),
            level: None,
        }
    }

    /// A function of the library; `T` must be its type.
    fn function<T>(&self, name: &[u8]) -> Option<Symbol<'_, T>> {
        // SAFETY: every caller names the type that the reference gives.
        unsafe { self.library.get(name) }.ok()
    }

    fn handle(&self) -> Handle {
        self.device as Handle
    }

    fn call(&self, name: &[u8]) -> Option<()> {
        let call = self.function::<Call>(name)?;
        (unsafe { call() } == SUCCESS).then_some(())
    }

    fn find(&self, name: &[u8], id: &str) -> Option<usize> {
        let find = self.function::<Find>(name)?;
        let (id, mut handle) = (CString::new(id).ok()?, std::ptr::null_mut());
        (unsafe { find(id.as_ptr(), &mut handle) } == SUCCESS).then_some(handle as usize)
    }

    /// A clock, MHz.
    fn clock(&self, kind: c_uint) -> Option<u32> {
        let get = self.function::<GetClock>(b"nvmlDeviceGetClockInfo\0")?;
        let mut mhz = 0;
        (unsafe { get(self.handle(), kind, &mut mhz) } == SUCCESS).then_some(mhz)
    }

    fn reasons(&self) -> Option<c_ulonglong> {
        let new = || self.function::<GetReasons>(b"nvmlDeviceGetCurrentClocksEventReasons\0");
        // What drivers before 535 call it.
        let old = || self.function::<GetReasons>(b"nvmlDeviceGetCurrentClocksThrottleReasons\0");
        let get = new().or_else(old)?;
        let mut reasons = 0;
        (unsafe { get(self.handle(), &mut reasons) } == SUCCESS).then_some(reasons)
    }

    fn held_back_ns(&self, policy: c_uint) -> Option<u64> {
        let get = self.function::<GetViolation>(b"nvmlDeviceGetViolationStatus\0")?;
        let mut violation = Violation::default();
        (unsafe { get(self.handle(), policy, &mut violation) } == SUCCESS).then_some(violation.held_back_ns)
    }
}

impl Drop for Nvml {
    fn drop(&mut self) {
        // Where it was not opened there is nothing to close, and nobody to be told.
        let _ = self.call(b"nvmlShutdown\0");
    }
}

fn reason_names(reasons: c_ulonglong) -> Vec<&'static str> {
    REASONS.iter().filter(|(bit, _)| reasons & bit != 0).map(|(_, name)| *name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_holds_clocks_back_against_the_users_wish_is_a_reason() {
        assert_eq!(reason_names(0), [""; 0]);
        // Idle, clocks set by the user, clocks set for a display.
        assert_eq!(reason_names(0x1 | 0x2 | 0x100), [""; 0]);
        assert_eq!(reason_names(0x4 | 0x40 | 0x2), ["power", "heat (hardware)"]);
    }

    #[test]
    fn a_violation_is_laid_out_as_nvml_has_it() {
        assert_eq!((size_of::<Violation>(), std::mem::offset_of!(Violation, held_back_ns)), (16, 8));
    }

    #[test]
    fn without_the_library_nothing_is_known() {
        assert!(Nvml::open_as("libof-no-machine.so.1", &Device::default()).is_none());
    }
}
