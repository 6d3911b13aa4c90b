//! The knowledge base: which obstacles must go first, which objects are derivable, which are locked.
//!
//! Each option of an object is a definite Horn rule: "all of these are relocated ⇒ the object can be picked". The rules are
//! those of pick-and-place, so a lock is a lock against pick-and-place.

mod base;
mod derivable;
mod grasp_model;
mod known;
mod lock;
mod options;
mod rows;
mod scene_base;

pub use base::KnowledgeBase;
pub use derivable::{Derivable, derivable};
pub use grasp_model::{GraspModel, SweptFinger, blockers};
pub use known::{KnownOption, ObjectKnowledge, known};
pub use lock::{Locks, locks};
pub use options::{Blocker, minimal_options};
pub use rows::Rows;
pub use scene_base::{MAX_BASE_SIZE, NoBase, complete, completed, fixed_blockers, relevant};
