//! The triangles of the meshes.

use glam::{DAffine3, DVec3, Vec2};

use super::accessor::Accessor;
use super::json::{Node, Primitive};
use super::source::Source;
use super::texture::Layout;
use crate::scene::mesh::Triangle;
use crate::scene::{SceneError, Warning};

/// The most triangles of a scene. A few bytes of JSON can place a mesh very often.
const MOST_TRIANGLES: usize = 1 << 26;

/// What gathers the triangles of all nodes.
#[derive(Debug)]
pub struct Surfaces<'a> {
    source: &'a Source,
    pub triangles: Vec<Triangle>,
    without_surface: u64,
    coloured: u64,
    deformed: u64,
    unplaced: u64,
}

impl<'a> Surfaces<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self {
            source,
            triangles: Vec::new(),
            without_surface: 0,
            coloured: 0,
            deformed: 0,
            unplaced: 0,
        }
    }

    /// Adds the mesh of a node.
    pub fn add(&mut self, node: &Node, transform: DAffine3) -> Result<(), SceneError> {
        let Some(index) = node.mesh else { return Ok(()) };
        let mesh = self.source.item(&self.source.document.meshes, "mesh", index)?;
        let weights = node.weights.as_ref().unwrap_or(&mesh.weights);
        let morphed = weights.iter().any(|&weight| weight != 0.0)
            && mesh.primitives.iter().any(|primitive| !primitive.targets.is_empty());
        self.deformed += u64::from(node.skin.is_some() || morphed);
        for primitive in &mesh.primitives {
            self.add_primitive(primitive, transform)?;
        }
        Ok(())
    }

    fn add_primitive(
        &mut self,
        primitive: &Primitive,
        transform: DAffine3,
    ) -> Result<(), SceneError> {
        let Some(&positions) = primitive.attributes.get("POSITION") else {
            self.without_surface += 1;
            return Ok(());
        };
        let positions = Accessor::positions(self.source, positions)?;
        let indices =
            primitive.indices.map(|index| Accessor::indices(self.source, index)).transpose()?;
        let count = indices.as_ref().map_or(positions.count, |indices| indices.count);
        let Some(corners) = self.corners(primitive.mode.unwrap_or(4), count)? else {
            self.without_surface += 1;
            return Ok(());
        };
        if corners.len() > MOST_TRIANGLES.saturating_sub(self.triangles.len()) {
            return Err(self.source.fault(format!(
                "more than {MOST_TRIANGLES} triangles; simplify it, or place its meshes less often"
            )));
        }
        let coordinates = self.coordinates(primitive)?;
        let vertex = |element: usize| {
            let element = indices.as_ref().map_or(Ok(element), |indices| indices.index(element))?;
            let uv = match &coordinates {
                Some((coordinates, layout)) => {
                    layout.place(coordinates.vector(element)?.truncate())
                }
                None => Vec2::ZERO,
            };
            Ok((self.finite(transform.transform_point3(positions.vector(element)?))?, uv))
        };
        let mirrored = transform.matrix3.determinant() < 0.0;
        let mut triangles = Vec::new();
        for triangle in 0..corners.len() {
            let [a, b, c] = corners.of(triangle);
            // A mirrored mesh keeps its front.
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            let [a, b, c] = [vertex(a)?, vertex(b)?, vertex(c)?];
            triangles.push(Triangle {
                corners: [a.0, b.0, c.0],
                uvs: [a.1, b.1, c.1],
                material: primitive.material,
            });
        }
        self.triangles.append(&mut triangles);
        self.coloured += u64::from(self.is_coloured(primitive)?);
        Ok(())
    }

    /// The texture coordinates that the material of a primitive asks for.
    fn coordinates(
        &mut self,
        primitive: &Primitive,
    ) -> Result<Option<(Accessor<'a>, Layout)>, SceneError> {
        let materials = &self.source.document.materials;
        let Some(index) = primitive.material else { return Ok(None) };
        let Some(layout) = Layout::of(self.source.item(materials, "material", index)?) else {
            return Ok(None);
        };
        let Some(&accessor) = primitive.attributes.get(&format!("TEXCOORD_{}", layout.set)) else {
            self.unplaced += 1;
            return Ok(None);
        };
        Ok(Some((Accessor::coordinates(self.source, accessor)?, layout)))
    }

    fn finite(&self, position: DVec3) -> Result<DVec3, SceneError> {
        match position.is_finite() {
            true => Ok(position),
            false => Err(self.source.fault("a node moves vertices to infinity; export it again")),
        }
    }

    /// How vertices make triangles; none if they make points or lines.
    fn corners(&self, mode: u32, count: usize) -> Result<Option<Corners>, SceneError> {
        Ok(Some(match mode {
            0..=3 => return Ok(None),
            4 if count.is_multiple_of(3) => Corners::List(count / 3),
            4 => {
                let what = format!("a list of triangles has {count} corners; export it again");
                return Err(self.source.fault(what));
            }
            5 => Corners::Strip(count.saturating_sub(2)),
            6 => Corners::Fan(count.saturating_sub(2)),
            _ => {
                let what = format!("a primitive of the unknown mode {mode}; export it again");
                return Err(self.source.fault(what));
            }
        }))
    }

    /// Whether vertices have colours other than white.
    fn is_coloured(&self, primitive: &Primitive) -> Result<bool, SceneError> {
        let Some(&colours) = primitive.attributes.get("COLOR_0") else { return Ok(false) };
        let colours = Accessor::colours(self.source, colours)?;
        for element in 0..colours.count {
            if colours.vector(element)? != DVec3::ONE {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// What was left out.
    pub fn warnings(&self) -> Vec<Warning> {
        let some = |count: u64, what: &str| {
            (count > 0).then(|| self.source.says(&format!("{count} {what}")))
        };
        let points = some(self.without_surface, "sets of points or lines are left out");
        let colours =
            some(self.coloured, "meshes have colours at their vertices, which are left out");
        let deformed = some(
            self.deformed,
            "meshes have a skin or morph targets, not supported yet; undeformed",
        );
        let unplaced = some(
            self.unplaced,
            "meshes lack the texture coordinates that their materials ask for; 0 is used",
        );
        let changed = [colours, deformed, unplaced].into_iter().flatten().map(Warning::changed);
        points.map(Warning::note).into_iter().chain(changed).collect()
    }
}

/// So many triangles of consecutive vertices.
#[derive(Debug, Clone, Copy)]
enum Corners {
    List(usize),
    Strip(usize),
    Fan(usize),
}

impl Corners {
    fn len(self) -> usize {
        match self {
            Self::List(count) | Self::Strip(count) | Self::Fan(count) => count,
        }
    }

    /// The vertices of the `i`th triangle. Every other one of a strip is turned.
    fn of(self, i: usize) -> [usize; 3] {
        match self {
            Self::List(_) => [3 * i, 3 * i + 1, 3 * i + 2],
            Self::Strip(_) if i.is_multiple_of(2) => [i, i + 1, i + 2],
            Self::Strip(_) => [i, i + 2, i + 1],
            Self::Fan(_) => [0, i + 1, i + 2],
        }
    }
}
