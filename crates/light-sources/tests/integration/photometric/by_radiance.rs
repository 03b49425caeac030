use core::f32::consts::PI;

use crate::photometric::model::*;
use light_sources::glam::{Affine3A, Vec3};
use light_sources::light_bounds::LightId;
use light_sources::light_math::spectrum::photometric::{Lumen, Lux, Nit, Watt};
use light_sources::shape::{ShapeDesc, Triangle};
use light_sources::*;

const LUMEN: SurfaceAmount = SurfaceAmount::LuminousPower(Lumen(800.0));
const WATT: SurfaceAmount = SurfaceAmount::RadiantPower(Watt(9.0));
const NIT: RadianceAmount = RadianceAmount::Luminance(Nit(120.0));
/// The disk that a scene of radius 3 shows.
const DISK: f32 = 9.0 * PI;

#[test]
fn a_surface_spreads_its_power_over_pi_times_its_area() {
    surfaces::<Rgb>("rgb");
    surfaces::<Spectral<4>>("spectral");
}

#[test]
fn a_mesh_shares_its_power_among_its_triangles() {
    meshes::<Rgb>("rgb");
    meshes::<Spectral<4>>("spectral");
}

#[test]
fn a_distant_light_has_its_illuminance() {
    distant::<Rgb>("rgb");
    distant::<Spectral<4>>("spectral");
}

#[test]
fn a_sun_has_its_illuminance_or_luminance() {
    sun::<Rgb>("rgb");
    sun::<Spectral<4>>("spectral");
}

#[test]
fn skies_have_their_luminance_over_four_pi() {
    skies::<Rgb>("rgb");
    skies::<Spectral<4>>("spectral");
}

#[test]
fn without_a_surface_there_is_no_power() {
    let area = |amount| {
        let color = SurfaceColor::<Rgb>::Uniform(Vec3::ONE);
        let no_shapes: [Triangle; 0] = [];
        DiffuseEmission::new(DiffuseEmissionDesc::new(color, amount), no_shapes).err()
    };
    let dark = Some(DiffuseEmissionError::Emission(EmissionError::Dark));
    assert_eq!(area(LUMEN), dark, "power");
    assert_eq!(area(NIT.into()), None, "luminance");
}

fn surfaces<M: Model>(name: &str) {
    // A disk of area 4 pi, its picture half white and half black.
    let shape = ShapeDesc::Disk {
        transform: Affine3A::IDENTITY,
        radius: 2.0,
        inner_radius: 0.0,
    };
    let picture = Image::from_f32([2, 1], Channels::Gray, vec![1.0, 0.0]).expect("an image");
    let alpha = Image::from_f32([1, 1], Channels::Gray, vec![0.25]).expect("an image");
    for (color, mask, mean) in [
        (SurfaceColor::Uniform(M::lamp()), EmissionMask::Opaque, 1.0),
        (
            SurfaceColor::Image {
                texture: picture.into(),
                tint: Vec3::ONE,
            },
            EmissionMask::Opaque,
            0.5,
        ),
        (
            SurfaceColor::Uniform(M::lamp()),
            EmissionMask::Alpha(alpha.into()),
            0.25,
        ),
    ] {
        for (sides, count) in [(Sides::Front, 1.0), (Sides::Both, 2.0)] {
            let area = |amount| {
                light_set(LightDesc::<M>::Area(AreaLightDesc {
                    shape,
                    emission: DiffuseEmissionDesc {
                        sides,
                        mask: mask.clone(),
                        ..DiffuseEmissionDesc::new(color.clone(), amount)
                    },
                }))
            };
            near(lumens(&area(LUMEN)), 800.0, name);
            let power = 120.0 * PI * 4.0 * PI * count * mean;
            near(lumens(&area(NIT.into())), power, name);
            let set = area(WATT);
            let watts = M::radiant(|w| set.get(LightId(0)).expect("one light").phi(w));
            near(watts, 9.0, name);
        }
    }
}

/// One triangle of two shows the bright middle of an image and the other its dark corner: the mesh
/// still emits the power that was asked for.
#[test]
fn a_textured_mesh_gives_off_what_it_was_asked_for() {
    let texels = vec![0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    let image = Image::from_f32([3, 3], Channels::Gray, texels).expect("an image");
    let uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.9, 0.2], [0.95, 0.0]];
    let set = light_set(LightDesc::<Rgb>::Mesh(MeshLightDesc {
        positions: [Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y, Vec3::Z].into(),
        indices: [[0, 1, 2], [1, 3, 4]].into(),
        uvs: Some(uvs.map(Into::into).into()),
        emission: DiffuseEmissionDesc::new(
            SurfaceColor::Image {
                texture: image.into(),
                tint: Vec3::ONE,
            },
            LUMEN,
        ),
    }));
    near(lumens(&set), 800.0, "both");
    let first = set.get(LightId(0)).expect("two lights");
    near(Rgb::luminous(|w| first.phi(w)), 800.0, "the bright one");
    // The tent of the middle texel over the triangle below its diagonal, half of it, of the mean 1
    // / 9.
    let set = light_set(LightDesc::<Rgb>::Mesh(MeshLightDesc {
        positions: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)].into(),
        indices: [[0, 1, 2]].into(),
        uvs: None,
        emission: DiffuseEmissionDesc::new(
            SurfaceColor::Image {
                texture: Image::from_f32(
                    [3, 3],
                    Channels::Gray,
                    vec![0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
                )
                .expect("an image")
                .into(),
                tint: Vec3::ONE,
            },
            NIT,
        ),
    }));
    near(lumens(&set), 120.0 * PI * 0.5 / 9.0, "half of a tent");
}

fn meshes<M: Model>(name: &str) {
    let mesh = |amount| {
        light_set(LightDesc::<M>::Mesh(MeshLightDesc {
            positions: [Vec3::ZERO, 2.0 * Vec3::X, Vec3::ONE, Vec3::Y].into(),
            indices: [[0, 1, 2], [0, 2, 3]].into(),
            uvs: None,
            emission: DiffuseEmissionDesc::new(SurfaceColor::Uniform(M::lamp()), amount),
        }))
    };
    near(lumens(&mesh(LUMEN)), 800.0, name);
    let area = 0.5 * (8f32.sqrt() + 2f32.sqrt());
    near(lumens(&mesh(NIT.into())), 120.0 * PI * area, name);
}

fn distant<M: Model>(name: &str) {
    let set = light_set(LightDesc::<M>::Distant(DistantLightDesc {
        direction: Vec3::Y,
        emission: M::lamp(),
        amount: IrradianceAmount::Illuminance(Lux(1000.0)),
    }));
    near(lumens(&set), 1000.0 * DISK, name);
}

fn sun<M: Model>(name: &str) {
    let sun = |amount| {
        light_set(LightDesc::<M>::Sun(SunLightDesc {
            direction: Vec3::Y,
            angular_diameter: 0.02,
            emission: M::lamp(),
            amount,
        }))
    };
    let lux = IrradianceAmount::Illuminance(Lux(1000.0));
    near(
        lumens(&sun(SunAmount::Irradiance(lux))),
        1000.0 * DISK,
        name,
    );
    let solid_angle = 4.0 * PI * 0.005f32.sin().powi(2);
    let power = 120.0 * solid_angle * DISK;
    near(lumens(&sun(SunAmount::Radiance(NIT))), power, name);
}

fn skies<M: Model>(name: &str) {
    let set = light_set(LightDesc::<M>::UniformInfinite(UniformInfiniteLightDesc {
        emission: M::lamp(),
        amount: NIT,
    }));
    near(lumens(&set), 120.0 * 4.0 * PI * DISK, name);

    let white = Image::from_f32([64, 64], Channels::Gray, vec![1.0; 64 * 64]).expect("an image");
    let map = EnvironmentMap::EqualArea(white);
    let set = light_set(LightDesc::<M>::ImageInfinite(ImageInfiniteLightDesc {
        transform: Affine3A::IDENTITY,
        map: map.clone(),
        amount: NIT,
    }));
    near(lumens(&set), 120.0 * 4.0 * PI * DISK, name);

    let set = light_set(LightDesc::<M>::PortalInfinite(PortalInfiniteLightDesc {
        transform: Affine3A::IDENTITY,
        map,
        portal: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
        amount: NIT,
    }));
    // Half of the sky emits light through one square metre.
    near(lumens(&set), 120.0 * PI, name);
}
