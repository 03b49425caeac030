use alloc::collections::BTreeSet;
use alloc::sync::Arc;

use crate::color::ColorModel;
use crate::diffuse_emission::DiffuseEmission;
use crate::image::Image;
use crate::light_set::LightSet;
use crate::mesh_indices::MeshIndices;
use crate::surface_texture::SurfaceTexture;
use crate::texture::Texture;

/// Memory of a [`LightSet`], in bytes; shared data counts once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightSetBytes {
    /// Vertices of meshes, which may be shared with the caller: positions, indices,
    /// surface parameters.
    pub vertices: usize,
    /// Images, the means of textures, and the sampling tables of environment maps.
    pub images: usize,
    /// The rest: lights, and where they are in the set. Of a light of a type of your own its own
    /// bytes alone, not what it points to.
    pub lights: usize,
}

/// Counts each piece of memory once.
#[derive(Default)]
struct Count {
    seen: BTreeSet<usize>,
    bytes: LightSetBytes,
}

impl<C: ColorModel> LightSet<C> {
    /// The memory of the set.
    #[must_use]
    pub fn bytes(&self) -> LightSetBytes {
        let mut count = Count::default();
        count.bytes.lights = self.own_bytes();
        for source in &self.lists.areas {
            count.emission(source.light().emission());
        }
        for mesh in self.lists.meshes.iter().chain(self.placed.meshes()) {
            let (positions, indices, uvs) = mesh.vertices();
            count.vertices(positions);
            if let MeshIndices::List(list) = indices {
                count.vertices(list);
            }
            uvs.into_iter().for_each(|uvs| count.vertices(uvs));
            if let Some(means) = mesh.means() {
                count.means(means.as_ptr().addr(), size_of_val(means));
            }
            count.emission(mesh.emission());
        }
        for light in &self.lists.projections {
            count.image(light.image());
            count.bytes.images += light.table_bytes();
        }
        for light in &self.lists.goniometrics {
            count.image(light.image());
            count.bytes.images += light.table_bytes();
        }
        for light in &self.lists.image_infinites {
            count.image(light.image());
            count.means(light.table_address(), light.table_bytes());
        }
        for light in &self.lists.portal_infinites {
            count.image(light.rectified());
            count.bytes.images += light.table_bytes();
        }
        for light in &self.lists.owns {
            count.own(light.memory());
        }
        count.bytes
    }
}

impl Count {
    fn vertices<T>(&mut self, list: &[T]) {
        if self.seen.insert(list.as_ptr().addr()) {
            self.bytes.vertices += size_of_val(list);
        }
    }

    fn image(&mut self, image: &Image) {
        if self.seen.insert(image.address()) {
            self.bytes.images += image.bytes();
        }
    }

    /// `bytes` of means or tables that lie at an address.
    fn means(&mut self, address: usize, bytes: usize) {
        if self.seen.insert(address) {
            self.bytes.images += bytes;
        }
    }

    fn own(&mut self, (address, bytes): (usize, usize)) {
        if self.seen.insert(address) {
            self.bytes.lights += bytes;
        }
    }

    fn texture(&mut self, texture: &Texture) {
        self.image(texture.image());
        let blocks = texture.blocks();
        self.means(core::ptr::from_ref(blocks).addr(), blocks.bytes());
    }

    fn emission<C: ColorModel>(&mut self, emission: &DiffuseEmission<C>) {
        let Some((textures, product)) = emission.texture().map(SurfaceTexture::parts) else {
            return;
        };
        textures.for_each(|texture| self.texture(texture));
        if let Some(blocks) = product {
            self.means(Arc::as_ptr(blocks).addr(), blocks.bytes());
        }
    }
}

#[cfg(all(test, feature = "half"))]
mod tests {
    use super::*;
    use crate::amount::RadianceAmount;
    use crate::area_desc::AreaLightDesc;
    use crate::channels::Channels;
    use crate::diffuse_emission_desc::{DiffuseEmissionDesc, EmissionMask, SurfaceColor};
    use crate::glam::{Affine3A, Vec2, Vec3};
    use crate::image_infinite_desc::EnvironmentMap;
    use crate::light_desc::LightDesc;
    use crate::light_set_builder::LightSetBuilder;
    use crate::mesh::MeshLightDesc;
    use crate::portal_infinite_desc::PortalInfiniteLightDesc;
    use crate::rgb::Rgb;
    use crate::scene_sphere::SceneSphere;
    use crate::shape::ShapeDesc;
    use alloc::vec;

    /// Images of single and of half precision, a mask that multiplies one, a portal with its table.
    #[test]
    fn every_image_of_a_set_counts() {
        let scene = SceneSphere::new(Vec3::ZERO, 2.0).expect("a sphere");
        let mut builder = LightSetBuilder::<Rgb>::new(scene);
        let half = half::f16::from_f32(0.5);
        let texture: Texture = Image::from_f16([8, 8], Channels::Gray, vec![half; 64])
            .expect("an image")
            .into();
        let mask: Texture = Image::from_f32([4, 4], Channels::Gray, vec![0.5; 16])
            .expect("an image")
            .into();
        let tint = Vec3::ONE;
        let shown = SurfaceColor::Image {
            texture: texture.clone(),
            tint,
        };
        for color in [SurfaceColor::Uniform(tint), shown] {
            let is_image = matches!(color, SurfaceColor::Image { .. });
            let opaque = DiffuseEmissionDesc::new(color, RadianceAmount::default());
            let emission = DiffuseEmissionDesc {
                mask: if is_image {
                    EmissionMask::Alpha(mask.clone().into())
                } else {
                    EmissionMask::Opaque
                },
                ..opaque
            };
            let shape = ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
            let area = LightDesc::Area(AreaLightDesc { shape, emission });
            builder.add(area).expect("a light");
            if !is_image {
                assert_eq!(builder.clone().build().bytes().images, 0, "no image");
            }
        }
        let of_surfaces = builder.clone().build().bytes().images;
        assert!(
            of_surfaces > texture.bytes() + mask.bytes(),
            "both and the means of their product: {of_surfaces}"
        );
        let map = Image::from_f32([4, 4], Channels::Gray, vec![1.0; 16]).expect("an image");
        let portal = PortalInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(map),
            amount: RadianceAmount::default(),
            portal: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
        };
        builder
            .add(LightDesc::PortalInfinite(portal))
            .expect("a light");
        let set = builder.build();
        let rectified = set.lists.portal_infinites[0].rectified();
        let [width, height] = rectified.size();
        let sums = width as usize * height as usize * size_of::<u64>();
        let of_portal = set.bytes().images - of_surfaces;
        assert_eq!(of_portal, rectified.bytes() + sums, "picture and table");
    }

    #[test]
    fn a_thousand_meshes_hold_their_image_once() {
        let image = Image::from_f32([64, 64], Channels::Gray, vec![0.5; 64 * 64]);
        let texture = Texture::new(image.expect("an image"));
        let scene = SceneSphere::new(Vec3::ZERO, 2.0).expect("a sphere");
        let mut builder = LightSetBuilder::<Rgb>::new(scene);
        for i in 0..1000u16 {
            let corner = Vec3::splat(f32::from(i));
            let mesh = MeshLightDesc {
                positions: [corner, corner + Vec3::X, corner + Vec3::Y].into(),
                indices: [[0, 1, 2]].into(),
                uvs: Some([Vec2::ZERO, Vec2::X, Vec2::Y].into()),
                emission: DiffuseEmissionDesc::new(
                    SurfaceColor::Image {
                        texture: texture.clone(),
                        tint: Vec3::ONE,
                    },
                    RadianceAmount::default(),
                ),
            };
            builder.add(LightDesc::Mesh(mesh)).expect("a light");
        }
        let bytes = builder.build().bytes();
        assert_eq!(bytes.vertices, 1000 * (36 + 12 + 24), "of each mesh");
        let means = 1000 * 12;
        assert_eq!(bytes.images, texture.bytes() + means, "of all together");
        assert!(
            texture.bytes() < 4 * 64 * 64 * 3 / 2,
            "the means are a third of a grey image"
        );
        let each = bytes.lights / 1000;
        assert!((100..400).contains(&each), "{each} bytes a mesh");
    }
}
