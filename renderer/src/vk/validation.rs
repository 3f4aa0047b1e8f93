//! Collects what the validation layers say. No message is suppressed: none seen so far is a false alarm.

use crate::{Error, Result};
use ash::vk;
use std::ffi::{CStr, c_void};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Messages kept word for word; further ones are only counted.
const KEPT_MESSAGES: usize = 64;

/// Every warning and error of the validation layers since the instance was made.
#[derive(Debug, Default)]
pub struct ValidationLog {
    messages: Mutex<Vec<String>>,
    count: AtomicU64,
}

impl ValidationLog {
    /// How many messages arrived.
    pub fn count(&self) -> u64 {
        self.count.load(Ordering::Acquire)
    }

    /// The first messages (at most 64), in order of arrival.
    pub fn messages(&self) -> Vec<String> {
        self.messages.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).clone()
    }

    /// [`Error::Internal`] with the first message and the number of all, if there is any.
    pub fn check(&self) -> Result<()> {
        match self.messages().first() {
            None => Ok(()),
            Some(first) => {
                Err(Error::Internal(format!("{} validation message(s), the first: {first}", self.count())))
            }
        }
    }

    fn push(&self, message: String) {
        let mut messages = self.messages.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if messages.len() < KEPT_MESSAGES {
            messages.push(message);
        }
        self.count.fetch_add(1, Ordering::AcqRel);
    }
}

/// The messenger that writes to `log`, which must outlive it.
///
/// Messages of type GENERAL are left out: they are the loader's notes about drivers and layers it skipped.
pub(super) fn messenger_info(log: &ValidationLog) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    use vk::{DebugUtilsMessageSeverityFlagsEXT as Severity, DebugUtilsMessageTypeFlagsEXT as Type};
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(Severity::WARNING | Severity::ERROR)
        .message_type(Type::VALIDATION | Type::PERFORMANCE)
        .pfn_user_callback(Some(on_message))
        .user_data(std::ptr::from_ref(log).cast_mut().cast())
}

/// Called by the layers, from any thread.
unsafe extern "system" fn on_message(
    severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    log: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer gives valid data for the length of the call; `log` is the ValidationLog of `messenger_info`.
    let (data, log) = unsafe { (&*data, &*log.cast::<ValidationLog>()) };
    let text = |pointer: *const std::ffi::c_char| match pointer.is_null() {
        true => String::new(),
        // SAFETY: a non-null string of the callback data is NUL-terminated.
        false => unsafe { CStr::from_ptr(pointer) }.to_string_lossy().replace('\n', " "),
    };
    let message = text(data.p_message);
    match severity.contains(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR) {
        true => tracing::error!("{message}"),
        false => tracing::warn!("{message}"),
    }
    log.push(message);
    vk::FALSE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_message_and_the_number_are_reported() {
        let log = ValidationLog::default();
        assert!(log.check().is_ok());
        for i in 0..100 {
            log.push(format!("message {i}"));
        }
        assert_eq!(log.messages().len(), KEPT_MESSAGES);
        let error = log.check().unwrap_err().to_string();
        assert_eq!(error, "100 validation message(s), the first: message 0");
    }
}
