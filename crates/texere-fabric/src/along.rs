//! The ways along which a knit is strained or held.

/// The way along which a knit is strained, or held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Along {
    /// Along the courses: the cloth has a given width, and its height is free.
    Courses,
    /// Along the wales: the cloth has a given height, and its width is free.
    Wales,
    /// Along both. A test strains the cloth by the same share along both.
    Both,
}

impl Along {
    /// All ways.
    pub const ALL: [Self; 3] = [Self::Courses, Self::Wales, Self::Both];

    /// `courses`, `wales` or `both`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Courses => "courses",
            Self::Wales => "wales",
            Self::Both => "both",
        }
    }

    /// The way of this name.
    ///
    /// ```
    /// use texere_fabric::Along;
    /// assert_eq!(Along::named("wales"), Some(Along::Wales));
    /// assert_eq!(Along::named("bias"), None);
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|along| along.name() == name)
    }

    /// The axes, x and y, along which the cloth keeps its length.
    pub(crate) const fn held(self) -> [bool; 2] {
        [matches!(self, Self::Courses | Self::Both), matches!(self, Self::Wales | Self::Both)]
    }

    /// The axis along which force and strain are compared.
    pub(crate) const fn axis(self) -> usize {
        matches!(self, Self::Wales) as usize
    }
}
