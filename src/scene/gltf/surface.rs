//! The triangles of the meshes.

use glam::{DAffine3, DVec3, Vec2, Vec3};

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
    clear: u64,
    smooth: u64,
    deformed: u64,
    unplaced: u64,
}

impl<'a> Surfaces<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self {
            source,
            triangles: Vec::new(),
            without_surface: 0,
            clear: 0,
            smooth: 0,
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
        let colors = primitive.attributes.get("COLOR_0");
        let colors = colors.map(|&colors| Accessor::colours(self.source, colors)).transpose()?;
        // Normals that cannot be read are as good as none: they are not shown.
        let normals = primitive.attributes.get("NORMAL");
        let normals = normals.and_then(|&normals| Accessor::positions(self.source, normals).ok());
        let element =
            |corner: usize| indices.as_ref().map_or(Ok(corner), |indices| indices.index(corner));
        let vertex = |corner: usize| {
            let element = element(corner)?;
            let color = match &colors {
                Some(colors) => colors.vector(element)?.as_vec3(),
                None => Vec3::ONE,
            };
            let uv = match &coordinates {
                Some((coordinates, layout)) => {
                    layout.place(coordinates.vector(element)?.truncate())
                }
                None => Vec2::ZERO,
            };
            let position = self.finite(transform.transform_point3(positions.vector(element)?))?;
            Ok((position, uv, color))
        };
        let normal = |corner: usize| normals.as_ref()?.vector(element(corner).ok()?).ok();
        let mut smooth = false;
        let mirrored = transform.matrix3.determinant() < 0.0;
        let mut triangles = Vec::new();
        for triangle in 0..corners.len() {
            let [a, b, c] = corners.of(triangle);
            // A mirrored mesh keeps its front.
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            smooth = smooth || differ([normal(a), normal(b), normal(c)]);
            let [a, b, c] = [vertex(a)?, vertex(b)?, vertex(c)?];
            triangles.push(Triangle {
                corners: [a.0, b.0, c.0],
                uvs: [a.1, b.1, c.1],
                colors: [a.2, b.2, c.2],
                material: primitive.material,
            });
        }
        self.triangles.append(&mut triangles);
        self.smooth += u64::from(smooth);
        self.clear += u64::from(colors.is_some_and(|colors| is_clear(&colors)));
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

    /// What was left out.
    pub fn warnings(&self) -> Vec<Warning> {
        let some = |count: u64, what: &str| {
            (count > 0).then(|| self.source.says(&format!("{count} {what}")))
        };
        let points = some(self.without_surface, "sets of points or lines are left out");
        let clear = some(self.clear, "meshes have colours with an alpha, which is left out");
        let smooth =
            some(self.smooth, "meshes have normals of smooth surfaces; they are shown flat");
        let deformed = some(
            self.deformed,
            "meshes have a skin or morph targets, not supported yet; undeformed",
        );
        let unplaced = some(
            self.unplaced,
            "meshes lack the texture coordinates that their materials ask for; 0 is used",
        );
        let changed =
            [clear, smooth, deformed, unplaced].into_iter().flatten().map(Warning::changed);
        points.map(Warning::note).into_iter().chain(changed).collect()
    }
}

/// Whether the normals of a triangle's corners, where they are known, are not the same.
fn differ(normals: [Option<DVec3>; 3]) -> bool {
    let [Some(a), Some(b), Some(c)] = normals else { return false };
    a.distance(b).max(a.distance(c)) > 1e-3
}

/// Whether colours have an alpha below 1.
fn is_clear(colors: &Accessor) -> bool {
    (0..colors.count).any(|element| colors.alpha(element).is_ok_and(|alpha| alpha < 1.0))
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
