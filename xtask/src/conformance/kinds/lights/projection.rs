use crate::conformance::{Case, Malformed};

/// The power of a grey picture in double precision, for a white of 1: with the solid angle per area at the centre of each texel, as the
/// reference adds it up, and with the solid angle of each texel.
pub(super) fn powers(case: &Case<'_>) -> Result<[f32; 2], Malformed> {
    let image = case.get("image")?;
    let (nx, ny) = (image.get("nx")?.index()?, image.get("ny")?.index()?);
    let channels = image.get("channels")?.index()?;
    let texels = image.get("texels")?.floats()?;
    let tan = (0.5 * f64::from(case.get("fov_deg")?.float()?).to_radians()).tan();
    let shorter = nx.min(ny) as f64;
    let corner = |i: usize, n: usize| (2.0 * i as f64 - n as f64) * tan / shorter;
    let up_to = |x: f64, y: f64| f64::atan2(x * y, (1.0 + x * x + y * y).sqrt());
    let (mut centers, mut exact) = (0.0, 0.0);
    for (i, texel) in texels.chunks(channels).enumerate() {
        let (i, j) = (i % nx, i / nx);
        let ([x0, x1], [y0, y1]) = (
            [i, i + 1].map(|i| corner(i, nx)),
            [j, j + 1].map(|j| corner(j, ny)),
        );
        let (x, y) = (0.5 * (x0 + x1), 0.5 * (y0 + y1));
        let texel = f64::from(texel[0]);
        centers += texel * (x1 - x0) * (y1 - y0) / (1.0 + x * x + y * y).powf(1.5);
        exact += texel * (up_to(x1, y1) - up_to(x0, y1) - up_to(x1, y0) + up_to(x0, y0));
    }
    let scale = f64::from(case.get("scale")?.float()?);
    Ok([centers, exact].map(|sum| (scale * sum) as f32))
}
