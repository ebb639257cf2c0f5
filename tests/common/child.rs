//! A process that a test has started: it ends with the test, whatever becomes of that.

use std::ops::{Deref, DerefMut};
use std::process::{Child, Command};

/// Dropped, it is killed and waited for.
#[derive(Debug)]
pub struct Started(Child);

impl Started {
    /// Starts a program.
    pub fn of(command: &mut Command) -> Self {
        Self(command.spawn().expect("the program starts"))
    }

    /// Sends it a signal, as Ctrl-C in a terminal sends SIGINT. The program `kill` is not everywhere, and
    /// crates that send signals safely (rustix, nix) turn on features of crates that the library is
    /// built with, so that it would be built twice.
    #[cfg(unix)]
    pub fn send(&self, signal: i32) {
        let id = libc::pid_t::try_from(self.0.id()).expect("a number of a process");
        #[expect(unsafe_code, reason = "what sends signals safely changes the library's build")]
        // SAFETY: two numbers are passed; the child is not waited for yet, so that its number is
        // that of no other process.
        let sent = unsafe { libc::kill(id, signal) };
        assert_eq!(sent, 0, "it has ended already");
    }
}

impl Deref for Started {
    type Target = Child;

    fn deref(&self) -> &Child {
        &self.0
    }
}

impl DerefMut for Started {
    fn deref_mut(&mut self) -> &mut Child {
        &mut self.0
    }
}

impl Drop for Started {
    fn drop(&mut self) {
        // Both are refused where it has ended and was waited for, which is as it should be.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
