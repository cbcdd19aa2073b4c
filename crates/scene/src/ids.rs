//! Typed indices into the arrays of a [`crate::Scene`].

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The index as a `usize`.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id!(
    /// Index into [`crate::Scene::meshes`].
    MeshId
);
id!(
    /// Index into [`crate::Scene::materials`].
    MaterialId
);
id!(
    /// Index into [`crate::Scene::textures`].
    TextureId
);
id!(
    /// Index into [`crate::Scene::media`].
    MediumId
);
id!(
    /// Index into [`crate::Scene::groups`].
    GroupId
);
