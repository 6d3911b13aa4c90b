//! The knowledge base: which obstacles must go first, which objects are derivable, which are locked.
//!
//! Each option of an object is a definite Horn rule: "all of these are moved ⇒ the object can be picked". The goal is one more
//! such rule. The rules are those of picking, so a lock is a lock against putting aside and taking away alike.

mod base;
mod derivable;
mod grasp_model;
mod known;
mod lock;
mod options;
mod rows;
mod scene_base;

pub use base::KnowledgeBase;
pub use derivable::{Chaining, Derivable, derivable};
pub use grasp_model::{GraspModel, SweptFinger, blockers};
pub use known::{KnownGrasp, KnownOption, ObjectKnowledge, known};
pub use lock::{Locks, locks};
pub use options::{Blocker, minimal_options};
pub use rows::Rows;
pub use scene_base::{MAX_BASE_SIZE, NoBase, complete, completed, fixed_blockers, of_goal, relevant};
