//! The form of names in files.
#![cfg(feature = "serde")]
#![allow(clippy::unwrap_used)]

use pendular_contact::{ContactModel, Dashpot, PlasticMemory};
use serde_json::{from_str, to_string, to_value};

#[test]
fn laws_are_their_names() {
    for model in ContactModel::ALL {
        assert_eq!(to_value(model).unwrap(), model.name());
    }
    assert_eq!(to_value(Dashpot::PushesOnly).unwrap(), "pushes_only");
}

#[test]
fn memory_survives_a_file() {
    let memory = PlasticMemory { max_overlap: 1.1e-6, plastic_overlap: 0.3e-6 };
    assert_eq!(from_str::<PlasticMemory>(&to_string(&memory).unwrap()).unwrap(), memory);
}
