//! The knowledge base: which obstacles must go first, which objects are derivable, which are locked.
//!
//! Each option of an object is a definite Horn rule: "all of these are relocated ⇒ the object is graspable".

mod base;
mod derivable;
mod lock;
mod options;
mod scene_base;

pub use base::KnowledgeBase;
pub use derivable::{Derivable, derivable};
pub use lock::{Locks, locks};
pub use options::{Blocker, minimal_options};
pub use scene_base::{
    MAX_BASE_SIZE, NoBase, OptionsOf, blockers, complete, completed, fixed_blockers, relevant, swept_finger_options,
};
