//! A description of each kind is a [`LightDesc`].

use crate::area_desc::AreaLightDesc;
use crate::color::ColorModel;
use crate::distant::DistantLightDesc;
use crate::goniometric::GoniometricLightDesc;
use crate::image_infinite_desc::ImageInfiniteLightDesc;
use crate::light_desc::LightDesc;
use crate::mesh::MeshLightDesc;
use crate::own_light::OwnLight;
use crate::point::PointLightDesc;
use crate::portal_infinite_desc::PortalInfiniteLightDesc;
use crate::projection::ProjectionLightDesc;
use crate::spot_desc::SpotLightDesc;
use crate::sun_desc::SunLightDesc;
use crate::uniform_infinite::UniformInfiniteLightDesc;

macro_rules! from_descriptions {
    ($($kind:ident: $desc:ty;)*) => {
        $(impl<C: ColorModel> From<$desc> for LightDesc<C> {
            fn from(desc: $desc) -> Self {
                Self::$kind(desc)
            }
        })*
    };
}

from_descriptions! {
    Point: PointLightDesc<C>;
    Spot: SpotLightDesc<C>;
    Projection: ProjectionLightDesc;
    Goniometric: GoniometricLightDesc<C>;
    Area: AreaLightDesc<C>;
    Mesh: MeshLightDesc<C>;
    Own: OwnLight<C>;
    Distant: DistantLightDesc<C>;
    Sun: SunLightDesc<C>;
    UniformInfinite: UniformInfiniteLightDesc<C>;
    ImageInfinite: ImageInfiniteLightDesc;
    PortalInfinite: PortalInfiniteLightDesc;
}
