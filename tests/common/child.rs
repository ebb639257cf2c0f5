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

    /// Asks it to end, as Ctrl-C in a terminal does.
    #[cfg(unix)]
    pub fn interrupt(&self) {
        use rustix::process::{Pid, Signal, kill_process};
        kill_process(Pid::from_child(&self.0), Signal::INT).expect("it still runs");
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
