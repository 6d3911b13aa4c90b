//! The paper's own methods, as printed: Kim, Jo, Lim & Kim, "Efficient Target Singulation with Multi-fingered Gripper using
//! Propositional Logic" (LOBS). Their known defects are reproduced and named, not repaired.
