use core::fmt::Write as _;
use core::slice::from_ref;
use std::path::PathBuf;

use clap::Args;
use light_scene::lights::photometry::{Luminaire, PhotometricWeb, WebType};
use light_scene::{in_luminaire, read_luminaire, write_atomically};
use serde_json::json;

use super::failure::Failure;
use super::output_file::{expect_another, expect_ending};
use super::stdout::say;

/// Show what a photometric file (.ies, .ldt) holds: lumens, type, peak, and a polar plot.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights ies lamp.ies
  lights ies lamp.ldt -o lamp.svg"
)]
pub(crate) struct IesArgs {
    /// The file: EULUMDAT if its name ends in .ldt, IESNA LM-63 otherwise.
    file: PathBuf,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
    /// Write the polar plot, an SVG picture: .svg.
    #[arg(short, long, value_name = "PLOT.svg")]
    output: Option<PathBuf>,
}

impl IesArgs {
    /// Reads the file, writes the plot and prints what the file holds.
    ///
    /// # Errors
    /// A file that cannot be read, or a plot that cannot be written.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if let Some(output) = &self.output {
            expect_another(output, from_ref(&self.file), "the one that is read")?;
            expect_ending(output, &["svg"])?;
        }
        let luminaire = read_luminaire(&self.file).map_err(Failure::input)?;
        if let Some(output) = &self.output {
            let plot = polar_plot(&luminaire.web);
            write_atomically(output, plot.as_bytes()).map_err(Failure::input)?;
        }
        if self.json {
            say!("{}", self.report(&luminaire))?;
        } else {
            self.print(&luminaire)?;
        }
        Ok(())
    }

    fn report(&self, luminaire: &Luminaire) -> serde_json::Value {
        let web = &luminaire.web;
        json!({
            "file": self.file.display().to_string(),
            "format": luminaire.format.to_string(),
            "type": web.web_type().to_string(),
            "lumens": web.total_lumens(),
            "peak_candelas": web.peak_candelas(),
            "lamp_lumens": luminaire.lamp_lumens,
            "efficiency": luminaire.efficiency(),
            "input_watts": luminaire.input_watts,
            "vertical_angles": web.vertical(),
            "horizontal_angles": web.horizontal(),
            "keywords": luminaire.keywords,
            "warnings": self.warnings(luminaire).collect::<Vec<_>>(),
        })
    }

    /// What is odd in the file, a line each.
    fn warnings<'a>(&'a self, luminaire: &'a Luminaire) -> impl Iterator<Item = String> + 'a {
        let warnings = luminaire.warnings.iter();
        warnings.map(|warning| in_luminaire(&self.file, warning).to_string())
    }

    fn print(&self, luminaire: &Luminaire) -> Result<(), Failure> {
        let web = &luminaire.web;
        say!("{}: {}", self.file.display(), luminaire.format)?;
        say!("lumens      {:.1}", web.total_lumens())?;
        say!("peak        {:.1} cd", web.peak_candelas())?;
        say!("type        {}", web.web_type())?;
        if let (Some(lamps), Some(part)) = (luminaire.lamp_lumens, luminaire.efficiency()) {
            say!(
                "lamps       {lamps:.1} lm, {:.1} % of it leaves",
                100.0 * part
            )?;
        }
        say!("input       {:.1} W", luminaire.input_watts)?;
        for (keyword, words) in &luminaire.keywords {
            if keyword.is_empty() {
                say!("{words}")?;
            } else {
                say!("[{keyword}] {words}")?;
            }
        }
        for warning in self.warnings(luminaire) {
            say!("warning: {warning}")?;
        }
        if self.output.is_none() {
            say!("plot        -o PLOT.svg draws it")?;
        }
        Ok(())
    }
}

/// The side of the plot.
const SIZE: f32 = 480.0;
/// The radius of the peak.
const RADIUS: f32 = 200.0;

/// Intensity by angle in two planes through the luminaire, the nadir below: across (drawn solid)
/// and along (dashed).
fn polar_plot(web: &PhotometricWeb) -> String {
    let peak = web.peak_candelas().max(f32::MIN_POSITIVE);
    let centre = 0.5 * SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"{SIZE}\" height=\"{SIZE}\" fill=\"white\"/>\n\
         <g fill=\"none\" stroke=\"#bbb\">\n"
    );
    for ring in 1..=4u8 {
        let r = RADIUS * f32::from(ring) / 4.0;
        let circle = format!("<circle cx=\"{centre}\" cy=\"{centre}\" r=\"{r}\"/>\n");
        svg.push_str(&circle);
    }
    for degrees in (0..360u16).step_by(30) {
        let (x, y) = polar(f32::from(degrees), RADIUS);
        let ray = format!("<path d=\"M{centre} {centre}L{x:.1} {y:.1}\"/>\n");
        svg.push_str(&ray);
    }
    svg.push_str("</g>\n");
    for (plane, dashes) in [(0.0, "none"), (90.0, "6 4")] {
        let mut path = String::new();
        for degrees in 0..=360u16 {
            let degrees = f32::from(degrees);
            let (x, y) = polar(degrees, RADIUS * candelas(web, plane, degrees) / peak);
            let command = if path.is_empty() { 'M' } else { 'L' };
            // Writing to a string does not fail.
            let _ = write!(path, "{command}{x:.1} {y:.1}");
        }
        let curve = format!(
            "<path d=\"{path}Z\" fill=\"none\" stroke=\"#c60\" stroke-width=\"2\" \
             stroke-dasharray=\"{dashes}\"/>\n"
        );
        svg.push_str(&curve);
    }
    let caption = format!(
        "<text x=\"8\" y=\"16\">{:.0} lm, peak {:.0} cd, type {}</text>\n\
         <text x=\"8\" y=\"{}\">solid: the plane of x, dashed: the plane of z; \
         rings at quarters of the peak</text>\n\
         </svg>\n",
        web.total_lumens(),
        web.peak_candelas(),
        web.web_type(),
        SIZE - 8.0
    );
    svg + &caption
}

/// The intensity at an angle from the nadir, toward the horizontal direction `plane` first.
fn candelas(web: &PhotometricWeb, plane: f32, degrees: f32) -> f32 {
    let (vertical, plane) = if degrees <= 180.0 {
        (degrees, plane)
    } else {
        (360.0 - degrees, plane + 180.0)
    };
    if web.web_type() == WebType::C {
        return web.at(vertical, plane);
    }
    let (sin_v, cos_v) = vertical.to_radians().sin_cos();
    let (sin_h, cos_h) = plane.to_radians().sin_cos();
    web.toward(light_scene::glam::Vec3::new(
        sin_v * cos_h,
        -cos_v,
        -sin_v * sin_h,
    ))
}

/// The place in the plot at an angle from below, counter-clockwise, and a distance from the middle.
fn polar(degrees: f32, radius: f32) -> (f32, f32) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    (0.5 * SIZE + radius * sin, 0.5 * SIZE + radius * cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plot_has_the_peak_at_the_outer_ring() {
        let web = PhotometricWeb::new(WebType::C, &[0.0, 90.0], &[0.0], &[100.0, 0.0]);
        let svg = polar_plot(&web.expect("a web"));
        assert!(
            svg.contains("d=\"M240.0 440.0L"),
            "the nadir is below: {svg}"
        );
        assert!(svg.ends_with("</svg>\n"), "whole");
    }
}
