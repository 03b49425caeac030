use std::fs;
use std::path::Path;

use bytemuck::{bytes_of, cast_slice};
use light_bounds::LightExtent;
use light_bvh::LightBvh;
use light_math::OctahedralVector;
use light_math::distribution::{AliasTable, PiecewiseConstant2D};
use light_math::glam::{Affine3A, Vec3};
use light_photometry::parse_lm63;
use light_sources::{
    Channels, EnvironmentMap, Image, ImageInfiniteLight, ImageInfiniteLightDesc, Light,
    RadianceAmount, Rgb, SceneSphere,
};

use crate::lights_file;
use crate::scene_records::{SkyRecord, WebRecord};
use crate::sky_file::{self, SkyPicture};

/// Names and bytes of all that goes into flash.
pub(crate) fn all(scene: &Path) -> Result<Vec<(&'static str, Vec<u8>)>, String> {
    let lights = read(scene, "room.lights", lights_file::lights)?;
    let points = read(scene, "room.points", lights_file::points)?;
    let picture = read(scene, "sky.ppm", sky_file::sky)?;
    let web = read(scene, "lamp.ies", web)?;
    let extents = lights
        .iter()
        .map(|light| Some(light.light()?.extent()))
        .collect::<Option<Vec<_>>>()
        .ok_or("room.lights: a light that cannot be")?;
    let tree = LightBvh::build(&extents).map_err(|e| e.to_string())?;
    let bounds: Vec<_> = extents.iter().filter_map(LightExtent::bounded).collect();
    let powers: Vec<f32> = bounds.iter().map(|bounds| bounds.phi).collect();
    let powers = AliasTable::new(&powers).map_err(|e| e.to_string())?;
    let axes: Vec<_> = bounds
        .iter()
        .map(|bounds| OctahedralVector::encode(bounds.w))
        .collect();
    let id = u32::try_from(lights.len()).map_err(|e| e.to_string())?;
    Ok(vec![
        ("tree.bin", tree.to_bytes()),
        ("lights.bin", cast_slice(&lights).to_vec()),
        ("points.bin", cast_slice(&points).to_vec()),
        ("powers.bin", cast_slice(powers.bins()).to_vec()),
        ("axes.bin", cast_slice(&axes).to_vec()),
        ("sky.bin", sky(&picture, id)?),
        ("web.bin", web),
    ])
}

/// What `parse` makes of a file of the scene.
fn read<T>(
    scene: &Path,
    name: &str,
    parse: impl Fn(&str) -> Result<T, String>,
) -> Result<T, String> {
    let error = |error: String| format!("scene/{name}: {error}");
    let text = fs::read_to_string(scene.join(name)).map_err(|e| error(e.to_string()))?;
    parse(&text).map_err(error)
}

/// The bytes of a lamp's intensities.
fn web(text: &str) -> Result<Vec<u8>, String> {
    let luminaire = parse_lm63(text, |_| Err("no other files".to_owned()));
    let web = luminaire.map_err(|e| e.to_string())?.web;
    let count = |angles: &[f32]| u32::try_from(angles.len()).map_err(|e| e.to_string());
    let record = WebRecord {
        vertical: count(web.vertical())?,
        horizontal: count(web.horizontal())?,
    };
    let view = web.view();
    let numbers = [view.vertical(), view.horizontal(), view.candelas()].concat();
    Ok([bytes_of(&record), cast_slice(&numbers)].concat())
}

/// The bytes of a sky with the given id, over the floor of the scene.
fn sky(picture: &SkyPicture, id: u32) -> Result<Vec<u8>, String> {
    let SkyPicture { size, texels } = picture;
    let n = *size as usize;
    // The table has to be the one that the owned light makes: of the means of the channels.
    let weights: Vec<f32> = texels
        .iter()
        .map(|&texel| Vec3::from_array(texel).element_sum() / 3.0)
        .collect();
    let table = PiecewiseConstant2D::new(&weights, n, n).map_err(|e| e.to_string())?;
    let image = Image::from_f32([*size; 2], Channels::Rgb, texels.concat());
    let light = ImageInfiniteLight::<Rgb>::new(
        ImageInfiniteLightDesc {
            map: EnvironmentMap::EqualArea(image.map_err(|e| e.to_string())?),
            transform: Affine3A::IDENTITY,
            amount: RadianceAmount::default(),
        },
        SceneSphere::new(Vec3::new(5.0, 5.0, 1.5), 8.0).map_err(|e| e.to_string())?,
    );
    let extent = light.map_err(|e| e.to_string())?.extent();
    let bounds = extent.infinite().ok_or("a sky is at infinity")?;
    let record = SkyRecord {
        size: *size,
        mean: table.mean(),
        fluence: bounds.fluence,
        direction: bounds.mean.to_array(),
        id,
    };
    let table = cast_slice(table.table());
    Ok([bytes_of(&record), table, cast_slice(texels)].concat())
}
