//! The scenes that come with the program.

/// Name and text of every built-in scene, in the order in which they are listed.
pub(crate) const SCENES: &[(&str, &str)] = &[
    ("demo", include_str!("../scenes/demo.toml")),
    ("e18-01", include_str!("../scenes/e18-01.toml")),
    ("e18-02", include_str!("../scenes/e18-02.toml")),
    ("e18-03", include_str!("../scenes/e18-03.toml")),
    ("e18-04", include_str!("../scenes/e18-04.toml")),
    ("e18-05", include_str!("../scenes/e18-05.toml")),
    ("e18-06", include_str!("../scenes/e18-06.toml")),
    ("e18-07", include_str!("../scenes/e18-07.toml")),
    ("e18-08", include_str!("../scenes/e18-08.toml")),
    ("e18-09", include_str!("../scenes/e18-09.toml")),
    ("e18-10", include_str!("../scenes/e18-10.toml")),
    ("e18-11", include_str!("../scenes/e18-11.toml")),
    ("e18-12", include_str!("../scenes/e18-12.toml")),
    ("e18-13", include_str!("../scenes/e18-13.toml")),
    ("e18-14", include_str!("../scenes/e18-14.toml")),
    ("e18-15", include_str!("../scenes/e18-15.toml")),
    ("e18-16", include_str!("../scenes/e18-16.toml")),
    ("e18-17", include_str!("../scenes/e18-17.toml")),
    ("e18-18", include_str!("../scenes/e18-18.toml")),
];

/// The text of a built-in scene.
pub(crate) fn find(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// All names, for messages.
pub(crate) fn names() -> String {
    SCENES.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}
