//! One run or sweep at a time writes a folder: a lock on a small file in it, which the system releases
//! however the program ends.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use crate::error::RunError;
use crate::say;

/// Stays in the folder: were it removed, two of them could each lock a file of that name.
const NAME: &str = "run.lock";

/// Held while a run or a sweep writes into its folder.
#[derive(Debug)]
pub(crate) struct Lock {
    folder: PathBuf,
    /// Whether there was no such folder before.
    made: bool,
    _file: File,
}

impl Lock {
    /// Takes the folder, which is made if there is none.
    pub(crate) fn take(folder: &Path) -> Result<Self, RunError> {
        let path = folder.join(NAME);
        let fail = |source| RunError::Write { path: path.clone(), source };
        let made = !folder.exists();
        fs::create_dir_all(folder).map_err(fail)?;
        let file = File::options().create(true).append(true).open(&path).map_err(fail)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(RunError::Busy { folder: folder.to_path_buf() });
            }
            // Some network drives cannot lock; a run there goes on as it is asked to.
            Err(TryLockError::Error(e)) => say::note(format_args!(
                "{} cannot be locked ({e}): let no other run write into it",
                folder.display()
            )),
        }
        Ok(Self { folder: folder.to_path_buf(), made, _file: file })
    }

    /// Leaves a folder as it was where a run could not begin and nothing but the lock is in it. One
    /// that was made for the run, as `ours` says too, goes.
    pub(crate) fn leave(self, ours: bool) {
        let alone = |mut all: fs::ReadDir| {
            all.all(|entry| entry.is_ok_and(|entry| entry.file_name() == NAME))
        };
        if fs::read_dir(&self.folder).is_ok_and(alone) {
            let _ = fs::remove_file(self.folder.join(NAME));
            if self.made || ours {
                let _ = fs::remove_dir(&self.folder);
            }
        }
    }
}

/// Refuses a folder that a run is writing into; nothing is made there.
pub(crate) fn refuse(folder: &Path) -> Result<(), RunError> {
    if folder.join(NAME).exists() { Lock::take(folder).map(drop) } else { Ok(()) }
}
