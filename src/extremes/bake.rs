//! A scene's text with all coordinates changed, in f64: small, large, far away or mirrored scenes
//! as a user has them, baked into the files.

use glam::{DVec3, dvec3};
use serde::Deserialize;
use toml::{Table, Value};

/// A change of coordinates: mirrored in x, then scaled, then moved.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bake {
    /// The factor of all lengths. Intensities grow with its square, so that radiance stays.
    pub scale: f64,
    /// What is added to all positions.
    pub offset: [f64; 3],
    /// Whether x changes its sign first. Faces turn with it, so that fronts stay fronts.
    pub mirror: bool,
}

impl Default for Bake {
    fn default() -> Self {
        Self { scale: 1.0, offset: [0.0; 3], mirror: false }
    }
}

/// What the keys of a scene file's tables hold.
const POINTS: [&str; 3] = ["position", "target", "center"];
const DIRECTIONS: [&str; 3] = ["direction", "up", "normal"];

impl Bake {
    fn direction(&self, direction: DVec3) -> DVec3 {
        if self.mirror { direction * dvec3(-1.0, 1.0, 1.0) } else { direction }
    }

    fn point(&self, point: DVec3) -> DVec3 {
        self.direction(point) * self.scale + DVec3::from_array(self.offset)
    }

    /// A scene file's text.
    ///
    /// # Errors
    /// It is no TOML, or moves its meshes itself.
    pub fn scene(&self, text: &str) -> Result<String, String> {
        if *self == Self::default() {
            return Ok(text.to_owned());
        }
        let mut scene: Table = toml::from_str(text).map_err(|error| error.to_string())?;
        if let Some(Value::Table(camera)) = scene.get_mut("camera") {
            self.table(camera)?;
        }
        for key in ["light", "sphere"] {
            for item in scene.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten() {
                item.as_table_mut().map_or(Ok(()), |table| self.table(table))?;
            }
        }
        let moves = |mesh: &Value| {
            ["translate", "rotate", "scale", "matrix"].iter().any(|key| mesh.get(key).is_some())
        };
        let meshes = scene.get("mesh").and_then(Value::as_array);
        if meshes.is_some_and(|meshes| meshes.iter().any(moves)) {
            return Err("a mesh with a transform cannot be baked".to_owned());
        }
        toml::to_string(&scene).map_err(|error| error.to_string())
    }

    fn table(&self, table: &mut Table) -> Result<(), String> {
        for (key, value) in table.iter_mut() {
            match key.as_str() {
                name if POINTS.contains(&name) => *value = array(self.point(vector(value)?)),
                name if DIRECTIONS.contains(&name) => {
                    *value = array(self.direction(vector(value)?));
                }
                "corners" => {
                    let corners = value.as_array_mut().ok_or("`corners` is no list")?;
                    for corner in corners.iter_mut() {
                        *corner = array(self.point(vector(corner)?));
                    }
                    if self.mirror {
                        corners.reverse();
                    }
                }
                "radius" => *value = Value::Float(self.scale * number(value)?),
                "intensity" => *value = array(self.scale * self.scale * vector(value)?),
                _ => {}
            }
        }
        Ok(())
    }

    /// An OBJ file's text.
    ///
    /// # Errors
    /// A vertex is not three numbers.
    pub fn obj(&self, text: &str) -> Result<String, String> {
        if *self == Self::default() {
            return Ok(text.to_owned());
        }
        let line = |line: &str| -> Result<String, String> {
            let mut words: Vec<_> = line.split_whitespace().collect();
            match words.first() {
                Some(&"v") => {
                    let numbers: Option<Vec<f64>> =
                        words[1..].iter().map(|word| word.parse().ok()).collect();
                    let [x, y, z] = numbers.as_deref().unwrap_or_default() else {
                        return Err(format!("`{line}` is no vertex of three numbers"));
                    };
                    let DVec3 { x, y, z } = self.point(dvec3(*x, *y, *z));
                    Ok(format!("v {x} {y} {z}"))
                }
                Some(&"f") if self.mirror => {
                    words[1..].reverse();
                    Ok(words.join(" "))
                }
                _ => Ok(line.to_owned()),
            }
        };
        let lines = text.lines().map(line).collect::<Result<Vec<_>, _>>()?;
        Ok(lines.join("\n") + "\n")
    }
}

fn number(value: &Value) -> Result<f64, String> {
    let number = value.as_float().or_else(|| value.as_integer().map(|integer| integer as f64));
    number.ok_or_else(|| format!("{value} is no number"))
}

fn vector(value: &Value) -> Result<DVec3, String> {
    let items = value.as_array().map(Vec::as_slice).unwrap_or_default();
    let numbers = items.iter().map(number).collect::<Result<Vec<_>, _>>()?;
    match numbers[..] {
        [x, y, z] => Ok(dvec3(x, y, z)),
        _ => Err(format!("{value} is no vector")),
    }
}

fn array(vector: DVec3) -> Value {
    Value::Array(vector.to_array().map(Value::Float).to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_mirrored_then_scaled_then_moved() {
        let bake = Bake { scale: 2.0, offset: [0.0, 0.0, 10.0], mirror: true };
        let obj = bake.obj("v 1 2 3\nvt 1 1\nf 1 2/1 -1\n").unwrap();
        assert_eq!(obj, "v -2 4 16\nvt 1 1\nf -1 2/1 1\n");
        let text = "[camera]\nposition = [1, 0, 0]\ndirection = [1, 0, 0.5]\n[[light]]\n\
                    radius = 3\nintensity = [1, 1, 2]\ncorners = [[1, 0, 0], [2, 0, 0]]\n";
        let scene: Table = toml::from_str(&bake.scene(text).unwrap()).unwrap();
        let light = &scene["light"][0];
        let vectors = [
            &scene["camera"]["position"],
            &scene["camera"]["direction"],
            &light["intensity"],
            &light["corners"][0],
        ]
        .map(|value| vector(value).unwrap().to_array());
        assert_eq!(
            vectors,
            [[-2.0, 0.0, 10.0], [-1.0, 0.0, 0.5], [4.0, 4.0, 8.0], [-4.0, 0.0, 10.0]]
        );
        assert_eq!(light["radius"].as_float(), Some(6.0));
        assert!(bake.obj("v 1 2\n").is_err() && bake.scene("[[mesh]]\nscale = 2\n").is_err());
    }
}
