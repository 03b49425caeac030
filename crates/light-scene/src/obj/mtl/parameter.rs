use crate::Diagnostic;
use crate::glam::Vec3;
use crate::text::{Line, shown};

/// The values of a parameter as `tobj` reads them: nothing of one that has no meaning here, `None`
/// of one that is not known.
///
/// # Errors
/// When a value is missing, or outside of its domain.
pub(super) fn written(keyword: &str, line: &mut Line<'_>) -> Result<Option<String>, Diagnostic> {
    let share = |line: &mut Line<'_>, what| at_least_zero(line, what).map(|n| n.min(1.0));
    Ok(Some(match keyword {
        "Kd" | "Ks" => of_color(color(line)?.min(Vec3::ONE)),
        "Ke" => of_color(color(line)?),
        "d" => share(line, "a dissolve")?.to_string(),
        "Tr" => share(line, "a transparency")?.to_string(),
        "Ni" => at_least_zero(line, "an index of refraction")?.to_string(),
        "Pr" => share(line, "a roughness")?.to_string(),
        "Pm" => share(line, "a metalness")?.to_string(),
        "illum" => illumination(line)?.to_string(),
        // Ambient light has no meaning in path tracing; the exponent belongs to the gloss of
        // `Ks`.
        "Ka" | "map_Ka" | "Ns" => String::new(),
        _ => return Ok(None),
    }))
}

/// Whether a parameter that is a share is above 1, which [`written`] makes of it.
pub(super) fn is_cut(keyword: &str, line: &Line<'_>) -> bool {
    let is_share = matches!(keyword, "Kd" | "Ks" | "d" | "Tr" | "Pr" | "Pm");
    is_share && color(&mut line.clone()).is_ok_and(|share| share.max_element() > 1.0)
}

fn of_color(Vec3 { x, y, z }: Vec3) -> String {
    format!("{x} {y} {z}")
}

/// Three channels, or one for all of them.
fn color(line: &mut Line<'_>) -> Result<Vec3, Diagnostic> {
    let red = at_least_zero(line, "a colour channel")?;
    let Some(green) = line.optional_number("a colour channel")? else {
        return Ok(Vec3::splat(red));
    };
    let color = Vec3::new(red, green, line.number("a colour channel")?);
    if color.min_element() < 0.0 {
        return Err(line.diagnostic("expected colour channels of at least 0"));
    }
    Ok(color)
}

fn at_least_zero(line: &mut Line<'_>, what: &str) -> Result<f32, Diagnostic> {
    let number = line.number(what)?;
    if number < 0.0 {
        return Err(line.diagnostic(format!("expected {what} of at least 0, found {number}")));
    }
    Ok(number)
}

fn illumination(line: &mut Line<'_>) -> Result<u8, Diagnostic> {
    let word = line.word().unwrap_or_default();
    let model = word.parse::<u8>().ok().filter(|model| *model <= 10);
    model.ok_or_else(|| {
        let message = format!(
            "expected an illumination model of 0 to 10, found `{}`",
            shown(word)
        );
        line.diagnostic(message)
    })
}
