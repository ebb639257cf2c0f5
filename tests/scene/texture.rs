//! Images and textures, by scene files.

use glam::{Vec2, Vec3, Vec4};
use gpu_vpl::error::SceneError;
use gpu_vpl::scene::{Scene, Texels};
use image::ImageFormat::{Bmp, Jpeg, Png, Tga};
use image::{DynamicImage, GrayImage, ImageBuffer, Rgba};

use super::pictures::{self, QUARTERS, encode, png, rgba};
use super::{CAMERA, MESH, MTL, load_bytes, warned};

const LIGHT: &str = "[[light]]\ntype = \"environment\"\nradiance = [1, 1, 1]\n";

/// Loads a scene whose mesh has a texture of this file, which line 11 names.
fn textured(name: &str, bytes: Option<&[u8]>) -> Result<Scene, SceneError> {
    let text = format!(
        "{CAMERA}[[mesh]]\nfile = \"mesh.obj\"\nmaterial = \"a\"\n\n\
         [materials.a]\n\ntexture = {name:?}\n{LIGHT}"
    );
    let mut files = vec![
        ("scene.toml", text.as_bytes()),
        ("mesh.obj", MESH.as_bytes()),
        ("mesh.mtl", MTL.as_bytes()),
    ];
    files.extend(bytes.map(|bytes| (name, bytes)));
    load_bytes(&files)
}

fn image(name: &str, bytes: &[u8]) -> Texels {
    let scene = textured(name, Some(bytes)).unwrap();
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    scene.images[scene.textures[0].image as usize].clone()
}

#[test]
fn images_of_all_formats_become_rgba() {
    let opaque = QUARTERS.map(|[r, g, b, _]| [r, g, b, 255]);
    for (name, bytes) in [("a.png", png(&QUARTERS)), ("a.tga", rgba(Tga, &QUARTERS))] {
        let image = image(name, &bytes);
        assert_eq!((image.size, &image.rgba[..]), ([2, 2], &QUARTERS[..]), "{name}");
    }
    let colors = QUARTERS.map(|[r, g, b, _]| [r, g, b]);
    // The name tells nothing.
    for (name, format) in [("a.png", Png), ("a", Bmp), ("a.TGA", Tga)] {
        let image = image(name, &pictures::rgb(format, 2, &colors));
        assert_eq!(image.rgba, opaque, "{name}");
    }
    // JPEG keeps a plain colour.
    let image = image("a.jpeg", &pictures::rgb(Jpeg, 2, &[[200, 100, 50]; 4]));
    for texel in &image.rgba {
        assert!(texel.iter().zip([200, 100, 50, 255]).all(|(a, b)| a.abs_diff(b) <= 3));
    }
}

#[test]
fn grey_and_16_bits_become_8_bits_of_colour() {
    let grey = GrayImage::from_raw(2, 1, vec![10, 200]).unwrap();
    let got = image("a.png", &encode(&DynamicImage::from(grey), Png));
    assert_eq!((got.size, &got.rgba[..]), ([2, 1], &[[10, 10, 10, 255], [200, 200, 200, 255]][..]));
    let texels = [0, 0x8080, 0xffff, 0x4040];
    let deep: ImageBuffer<Rgba<u16>, _> = ImageBuffer::from_raw(1, 1, texels.to_vec()).unwrap();
    let got = image("a.png", &encode(&DynamicImage::from(deep), Png));
    assert_eq!(got.rgba, [[0, 0x80, 0xff, 0x40]]);
}

#[test]
fn a_texture_is_interpolated_in_linear_light() {
    let scene = textured("a.png", Some(&png(&QUARTERS))).unwrap();
    let material = &scene.materials[scene.triangles[0].material as usize];
    assert_eq!((material.texture, material.albedo, material.cutout), (Some(0), Vec3::ONE, None));
    let at = |u: f32, v: f32| scene.textures[0].sample(&scene.images, Vec2::new(u, v));
    let near = |got: Vec4, expected: [f32; 4]| {
        assert!(got.distance(Vec4::from_array(expected)) < 1e-5, "{got} {expected:?}");
    };
    // 188 / 255 of sRGB are ((188 / 255 + 0.055) / 1.055)^2.4 = 0.502886 of light.
    let grey = 0.502_886;
    near(at(0.25, 0.25), [1.0, 0.0, 0.0, 1.0]);
    near(at(0.75, 0.75), [grey, grey, grey, 0.0]);
    near(at(0.5, 0.25), [0.5, 0.5, 0.0, 0.5 * (1.0 + 200.0 / 255.0)]);
    near(at(0.25, 0.5), [0.5, 0.0, 0.5, 0.5 * (1.0 + 100.0 / 255.0)]);
    // A quarter from the first column to the second: half a texel is a quarter of the image.
    near(at(0.375, 0.25), [0.75, 0.25, 0.0, 0.75 + 0.25 * 200.0 / 255.0]);
    // Repeated: the border lies between the last column and the first.
    near(at(0.0, 0.25), [0.5, 0.5, 0.0, 0.5 * (1.0 + 200.0 / 255.0)]);
    near(at(-2.75, 3.25), [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn a_texture_multiplies_the_albedo_and_is_read_once() {
    let text = format!(
        "{CAMERA}[[mesh]]\nfile = \"mesh.obj\"\n[materials.one]\nalbedo = [0.5, 0.25, 1]\n\
         texture = \"a.png\"\n[materials.two]\ntexture = \"a.png\"\ntype = \"phong\"\n\
         specular = [0.25, 0, 1]\nshininess = 5\n{LIGHT}"
    );
    let png = png(&QUARTERS);
    let files = [
        ("scene.toml", text.as_bytes()),
        ("mesh.obj", MESH.as_bytes()),
        ("mesh.mtl", MTL.as_bytes()),
        ("a.png", &png),
    ];
    let scene = load_bytes(&files).unwrap();
    assert_eq!((scene.images.len(), scene.textures.len()), (1, 1));
    let [one, two] = [0, 1].map(|i| &scene.materials[scene.triangles[i].material as usize]);
    assert_eq!((one.texture, one.albedo), (Some(0), Vec3::new(0.5, 0.25, 1.0)));
    assert_eq!((two.texture, two.albedo), (Some(0), Vec3::new(0.75, 1.0, 0.0)));
}

#[test]
fn a_bad_image_is_magenta_with_a_warning_that_names_it() {
    let good = png(&QUARTERS);
    let jpeg = rgba(Jpeg, &QUARTERS);
    let mut corrupt = good.clone();
    *corrupt.last_mut().unwrap() ^= 1;
    corrupt[45] ^= 0xff;
    for (name, bytes, what) in [
        ("a.png", None, "is not there"),
        (".", None, "is not there"),
        ("a.png", Some(Vec::new()), "unknown format"),
        ("a.gif", Some(b"GIF89a".to_vec()), "is damaged"),
        ("a.txt", Some(b"hello".to_vec()), "unknown format"),
        ("a.tga", Some(b"hello".to_vec()), "is damaged"),
        ("a.png", Some(corrupt), "is damaged"),
        ("a.png", Some(good[..good.len() / 2].to_vec()), "is damaged"),
        ("a.jpg", Some(jpeg[..20].to_vec()), "is damaged"),
        ("a.png", Some(pictures::claims(0, 0)), "is damaged"),
        ("a.png", Some(pictures::claims(16385, 1)), "is larger than 16384"),
        ("a.png", Some(pictures::claims(1, u32::MAX)), "is"),
        ("a.png", Some(pictures::claims(16384, 16384)), "more than its bytes can hold"),
    ] {
        let scene = textured(name, bytes.as_deref()).unwrap();
        let image = &scene.images[scene.textures[0].image as usize];
        assert_eq!((image.size, &image.rgba[..]), ([1, 1], &[[255, 0, 255, 255]][..]), "{name}");
        let found: Vec<_> = scene.warnings.iter().map(|warning| &warning.message).collect();
        assert_eq!(found.len(), 1, "{name}: {found:?}");
        assert!(found[0].starts_with("scene.toml:11: image "), "{}", found[0]);
        assert!(found[0].ends_with("; magenta is shown"), "{}", found[0]);
        assert!(!found[0].contains('\n'));
        warned(&scene, what, true);
    }
}
