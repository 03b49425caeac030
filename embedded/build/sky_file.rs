use light_math::glam::Vec3;

/// A square picture.
pub(crate) struct SkyPicture {
    pub(crate) size: u32,
    pub(crate) texels: Vec<[f32; 3]>,
}

/// The picture of a PPM file of text, whose values are thousandths of W m^-2 sr^-1.
pub(crate) fn sky(text: &str) -> Result<SkyPicture, String> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let mut words = lines.flat_map(str::split_whitespace);
    let mut next = || words.next().ok_or("it ends too early");
    if next()? != "P3" {
        return Err("expected P3".to_owned());
    }
    let mut number = || {
        let word = next()?;
        let number = word.parse::<u16>();
        number.map_err(|_| format!("expected a number below 65536: {word}"))
    };
    let [width, height, _largest] = [number()?, number()?, number()?];
    if width != height {
        return Err("an equal-area picture is square".to_owned());
    }
    let mut texel = || {
        let rgb = [number()?, number()?, number()?].map(f32::from);
        Ok((Vec3::from_array(rgb) * 1e-3).to_array())
    };
    let texels = (0..u32::from(width) * u32::from(height)).map(|_| texel());
    let texels = texels.collect::<Result<_, String>>()?;
    Ok(SkyPicture {
        size: width.into(),
        texels,
    })
}
