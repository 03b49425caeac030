//! The kinds of light, in one table: the enums with one entry a kind and the lists of a set are made
//! from it.

use alloc::vec::Vec;

use crate::area_desc::AreaSource;
use crate::color::ColorModel;
use crate::distant::DistantLight;
use crate::goniometric::GoniometricLight;
use crate::image_infinite::ImageInfiniteLight;
use crate::mesh::MeshLight;
use crate::own_light::OwnLight;
use crate::point::PointLight;
use crate::portal_infinite::PortalInfiniteLight;
use crate::projection::ProjectionLight;
use crate::spot::SpotLight;
use crate::sun::SunLight;
use crate::uniform_infinite::UniformInfiniteLight;

/// Calls the macro `$table` with the kinds, those that are always at infinity last: the name of a
/// kind, the list of a set that holds it, and what is in that list. What follows `$table` goes
/// before them.
macro_rules! light_kinds {
    ($table:ident! $($before:tt)*) => {
        $table! {
            $($before)*
            Point, points: PointLight<C>;
            Spot, spots: SpotLight<C>;
            Projection, projections: ProjectionLight<C>;
            Goniometric, goniometrics: GoniometricLight<C>;
            Area, areas: AreaSource<C>;
            Triangle, meshes: MeshLight<C>;
            Own, owns: OwnLight<C>;
            Distant, distants: DistantLight<C>;
            Sun, suns: SunLight<C>;
            UniformInfinite, uniform_infinites: UniformInfiniteLight<C>;
            ImageInfinite, image_infinites: ImageInfiniteLight<C>;
            PortalInfinite, portal_infinites: PortalInfiniteLight<C>;
        }
    };
}
pub(crate) use light_kinds;

macro_rules! kinds_and_lists {
    ($($kind:ident, $list:ident: $stored:ty;)*) => {
        /// The kinds of light; those that are always at infinity come last.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub(crate) enum LightKind {
            $($kind,)*
        }

        /// A source of light of any kind: one light, or all triangles of a mesh.
        #[derive(Debug)]
        pub(crate) enum LightSource<C: ColorModel> {
            $($kind($stored),)*
        }

        /// The sources of light of a set, by kind.
        #[derive(Clone, Debug)]
        pub(crate) struct LightLists<C: ColorModel> {
            $(pub(crate) $list: Vec<$stored>,)*
        }

        impl<C: ColorModel> LightSource<C> {
            pub(crate) const fn kind(&self) -> LightKind {
                match self {
                    $(Self::$kind(_) => LightKind::$kind,)*
                }
            }
        }

        impl<C: ColorModel> LightLists<C> {
            pub(crate) const EMPTY: Self = Self { $($list: Vec::new(),)* };

            /// The number of sources of a kind.
            pub(crate) fn len(&self, kind: LightKind) -> usize {
                match kind {
                    $(LightKind::$kind => self.$list.len(),)*
                }
            }

            pub(crate) fn push(&mut self, source: LightSource<C>) {
                match source {
                    $(LightSource::$kind(source) => self.$list.push(source),)*
                }
            }

            /// Puts a source in place of one of its kind.
            pub(crate) fn replace(&mut self, index: usize, source: LightSource<C>) {
                match source {
                    $(LightSource::$kind(source) => self.$list[index] = source,)*
                }
            }

            /// Bytes of the lists themselves.
            pub(crate) fn bytes(&self) -> usize {
                [$(size_of_val(&*self.$list),)*].into_iter().sum()
            }
        }
    };
}

light_kinds!(kinds_and_lists!);

impl<C: ColorModel> LightSource<C> {
    /// Whether it is at infinity.
    pub(crate) fn is_infinite(&self) -> bool {
        match self {
            Self::Own(light) => light.is_infinite(),
            _ => self.kind() >= LightKind::Distant,
        }
    }

    /// How many lights it is.
    pub(crate) fn lights(&self) -> usize {
        match self {
            Self::Triangle(mesh) => mesh.len(),
            _ => 1,
        }
    }
}
