use alloc::rc::Rc;

use super::parameters::Parameters;

/// The kind of directive that an `Attribute` applies to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    Shape,
    Light,
    Material,
    Medium,
    Texture,
}

/// The `Attribute` directives in force, the last one at the end.
pub(super) type Attributes = Vec<(Target, Rc<Parameters>)>;

impl Target {
    pub(super) fn of_name(name: &str) -> Option<Self> {
        Some(match name {
            "shape" => Self::Shape,
            "light" => Self::Light,
            "material" => Self::Material,
            "medium" => Self::Medium,
            "texture" => Self::Texture,
            _ => return None,
        })
    }

    pub(super) fn of_directive(directive: &str) -> Option<Self> {
        Some(match directive {
            "Shape" => Self::Shape,
            "LightSource" | "AreaLightSource" => Self::Light,
            "Material" | "MakeNamedMaterial" => Self::Material,
            "MakeNamedMedium" => Self::Medium,
            "Texture" => Self::Texture,
            _ => return None,
        })
    }
}
