//! Features of glTF, each with a model of a few numbers.

use crate::made::{floats, model, scene_at, scene_of};
use glam::{DVec3, Vec2, Vec3};
use heliostat_io::gltf::Moment;
use heliostat_scene::material::{Channel, Relief, Standard, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::texture::{Filtering, Minify, Pattern, UvSet, Wrap};
use heliostat_scene::{Material, Rgb, Scene};

/// Three corners and what else a model of one triangle needs.
fn triangle(json: &str) -> Scene {
    scene_of(triangle_bytes(json, ""))
}

fn triangle_bytes(json: &str, primitive: &str) -> Vec<u8> {
    let binary = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    let rest = format!(
        r#""bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "accessors": [{{"bufferView": 0, "count": 3, "componentType": 5126, "type": "VEC3"}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}} {primitive}}}]}}] {json}"#
    );
    model(&rest, &binary)
}

/// The material of a triangle.
fn material(json: &str) -> Material {
    let image = r#", "textures": [{"source": 0, "sampler": 0}, {"source": 0}], "images": [{"uri": "data:,x"}],
        "samplers": [{"magFilter": 9728, "wrapS": 33071, "wrapT": 33648}]"#;
    let nodes = r#", "nodes": [{"mesh": 0}]"#;
    let json = format!(r#"{nodes} {image}, "materials": [{json}]"#);
    scene_of(triangle_bytes(&json, r#", "material": 0"#)).materials.remove(0)
}

fn standard(json: &str) -> Standard {
    match material(json).surface {
        Surface::Standard(standard) => *standard,
        other => panic!("{other:?}"),
    }
}

#[test]
fn nodes_place_objects_and_flat_ones_show_nothing() {
    let scene = triangle(
        r#", "nodes": [{"children": [1, 2], "translation": [0, 0, 4]}, {"mesh": 0, "name": "a", "scale": [-2, 1, 1]},
            {"mesh": 0, "name": "a", "scale": [0, 1, 1]}]"#,
    );
    assert_eq!((scene.objects.len(), scene.meshes.len()), (1, 1));
    let place = scene.objects[0].motion.first();
    assert_eq!(place.point(Vec3::X), Vec3::new(-2.0, 0.0, 4.0));
    assert!(place.is_mirror());
    let copies = triangle(r#", "nodes": [{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "a"}]"#);
    assert_eq!((copies.objects[0].name.as_str(), copies.objects[1].name.as_str()), ("a", "a.2"));
    assert_eq!(
        (copies.meshes.len(), copies.objects[1].geometry.clone()),
        (1, Geometry::Mesh(heliostat_scene::MeshId(0)))
    );
}

#[test]
fn strips_turn_every_second_triangle_and_fans_start_in_one_corner() {
    let corners = [[0., 0.], [1., 0.], [0., 1.], [1., 1.]].map(|[x, y]| floats(&[x, y, 0.])).concat();
    let read = |mode: u32| {
        let json = format!(
            r#""bufferViews": [{{"buffer": 0, "byteLength": 48}}], "nodes": [{{"mesh": 0}}],
            "accessors": [{{"bufferView": 0, "count": 4, "componentType": 5126, "type": "VEC3"}}],
            "meshes": [{{"primitives": [{{"mode": {mode}, "attributes": {{"POSITION": 0}}}}]}}]"#
        );
        scene_of(model(&json, &corners)).meshes.iter().flat_map(|m| m.triangles.clone()).collect::<Vec<_>>()
    };
    assert_eq!(read(4), [[0, 1, 2]]);
    assert_eq!(read(5), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(read(6), [[1, 2, 0], [2, 3, 0]]);
    assert!(read(1).is_empty());
}

#[test]
fn quantised_numbers_and_both_sets_of_coordinates_are_read() {
    // Positions in shorts, padded to eight bytes; coordinates in shares of bytes and of shorts.
    let positions: [i16; 12] = [0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0];
    let mut binary = positions.map(i16::to_le_bytes).concat();
    binary.extend([0, 0, 255, 0, 0, 255, 0, 0]);
    binary.extend([0_u16, 0, 65535, 0, 0, 65535].map(u16::to_le_bytes).concat());
    let scene = scene_of(model(
        r#""bufferViews": [{"buffer": 0, "byteLength": 24, "byteStride": 8}, {"buffer": 0, "byteOffset": 24, "byteLength": 6},
            {"buffer": 0, "byteOffset": 32, "byteLength": 12}],
        "accessors": [{"bufferView": 0, "count": 3, "componentType": 5122, "type": "VEC3"},
            {"bufferView": 1, "count": 3, "componentType": 5121, "type": "VEC2", "normalized": true},
            {"bufferView": 2, "count": 3, "componentType": 5123, "type": "VEC2", "normalized": true}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2}}]}],
        "extensionsRequired": ["KHR_mesh_quantization"], "nodes": [{"mesh": 0}]"#,
        &binary,
    ));
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.positions, [Vec3::ZERO, 100.0 * Vec3::X, 100.0 * Vec3::Y]);
    let upwards = [Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(0.0, 0.0)];
    assert_eq!((mesh.uvs.as_slice(), mesh.uvs1.as_slice()), (&upwards[..], &upwards[..]));
    assert!(mesh.normals.is_empty(), "facets, as the specification says");
}

#[test]
fn only_vertices_that_triangles_name_are_kept() {
    let mut binary = floats(&[9., 9., 9., 0., 0., 0., 1., 0., 0., 9., 9., 9., 0., 1., 0.]);
    binary.extend([4, 1, 2]);
    let scene = scene_of(model(
        r#""bufferViews": [{"buffer": 0, "byteLength": 60}, {"buffer": 0, "byteOffset": 60, "byteLength": 3}],
        "accessors": [{"bufferView": 0, "count": 5, "componentType": 5126, "type": "VEC3"},
            {"bufferView": 1, "count": 3, "componentType": 5121, "type": "SCALAR"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "nodes": [{"mesh": 0}]"#,
        &binary,
    ));
    assert_eq!(scene.meshes[0].positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(scene.meshes[0].triangles, [[2, 0, 1]]);
}

#[test]
fn wrong_files_name_their_place_and_mend() {
    for (json, primitive, expected) in [
        (
            r#", "nodes": [{"mesh": 7}]"#,
            "",
            "nodes[0].mesh: names meshes[7], but there are 1; export the file again",
        ),
        (
            r#", "nodes": [{"mesh": 0}]"#,
            r#", "indices": 3"#,
            "meshes[0].primitives[0].indices: names accessors[3], but there are 1; export the file again",
        ),
        (
            r#", "nodes": [{"mesh": 0}]"#,
            r#", "indices": 0"#,
            "meshes[0].primitives[0].indices (accessors[0]): must hold Scalar; export the file again",
        ),
        (
            r#", "extensionsRequired": ["KHR_texture_basisu"]"#,
            "",
            "extensionsRequired: needs the extension KHR_texture_basisu, which is not read; convert its textures with `gltf-transform ktxdecompress in.glb out.glb`",
        ),
    ] {
        let error = scene_at(triangle_bytes(json, primitive), &Moment::default()).expect_err(json);
        assert_eq!(error.to_string(), format!("made.glb: {expected}"));
    }
}

#[test]
fn the_core_material_is_a_standard_surface() {
    let json = r#"{"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5,
        "roughnessFactor": 0.6, "metallicRoughnessTexture": {"index": 1, "texCoord": 1}}, "emissiveFactor": [1, 0, 2],
        "normalTexture": {"index": 1, "scale": 0.7},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}}}"#;
    let material = material(json);
    assert!(matches!(material.relief, Some(Relief::Normal { strength: 0.7, .. })));
    assert_eq!((material.opacity.factor, material.cutoff), (1.0, None), "opaque, whatever the alpha");
    let standard = standard(json);
    assert_eq!(standard.base_color.factor, Rgb::new(0.1, 0.2, 0.3));
    assert_eq!((standard.metalness.factor, standard.metalness.channel), (0.5, Channel::B));
    assert_eq!((standard.roughness.factor, standard.roughness.channel), (0.6, Channel::G));
    assert_eq!(standard.metalness.texture, standard.roughness.texture);
    assert_eq!(standard.emission.factor, Rgb::new(3.0, 0.0, 6.0));
}

#[test]
fn alpha_is_coverage_where_it_counts() {
    let with = |mode: &str| {
        let json = format!(
            r#"{{"alphaMode": "{mode}", "pbrMetallicRoughness": {{"baseColorFactor": [1, 1, 1, 0.3]}}}}"#
        );
        let material = material(&json);
        (material.opacity.factor, material.cutoff)
    };
    assert_eq!((with("OPAQUE"), with("BLEND"), with("MASK")), ((1.0, None), (0.3, None), (0.3, Some(0.5))));
}

#[test]
fn glass_absorbs_what_its_colour_says_after_its_distance() {
    let glass = |volume: &str| {
        let transmission = r#""KHR_materials_transmission": {"transmissionFactor": 0.9}"#;
        standard(&format!(r#"{{"extensions": {{{transmission} {volume}}}}}"#))
    };
    assert!(glass("").thin_walled);
    let solid = glass(
        r#", "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [0.25, 1, 0]}"#,
    );
    assert!(!solid.thin_walled);
    let left = (-2.0 * solid.absorption).exp();
    assert!((left.x - 0.25).abs() < 1e-6 && left.y == 1.0 && left.z < 1e-30, "{left}");
}

#[test]
fn every_layer_has_its_extension() {
    let s = standard(
        r#"{"extensions": {"KHR_materials_ior": {"ior": 0}, "KHR_materials_specular": {"specularFactor": 0.2, "specularColorFactor": [1, 2, 3]},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.3, "clearcoatRoughnessFactor": 0.4, "clearcoatNormalTexture": {"index": 0}},
        "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.5},
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 0.7, "anisotropyTexture": {"index": 0}},
        "KHR_materials_iridescence": {"iridescenceFactor": 0.8, "iridescenceIor": 1.4, "iridescenceThicknessMaximum": 500},
        "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.9, "diffuseTransmissionColorFactor": [0.5, 0.6, 0.7]},
        "KHR_materials_dispersion": {"dispersion": 1.5}}}"#,
    );
    assert!(s.ior > 100.0, "reflects all");
    assert_eq!((s.specular.factor, s.specular_color.factor), (0.2, Rgb::new(1.0, 2.0, 3.0)));
    assert_eq!((s.coat.factor, s.coat_roughness.factor, s.coat_relief.is_some()), (0.3, 0.4, true));
    assert_eq!((s.sheen_color.factor, s.sheen_roughness.factor), (Rgb::new(0.1, 0.2, 0.3), 0.5));
    assert_eq!((s.anisotropy.factor, s.anisotropy_rotation), (0.6, 0.7));
    assert_eq!((s.anisotropy_direction, s.anisotropy.channel), (s.anisotropy.texture, Channel::B));
    let film = s.thin_film;
    assert_eq!((film.weight.factor, film.ior, film.least + film.thickness.factor), (0.8, 1.4, 500.0));
    assert_eq!((s.diffuse_transmission.factor, s.diffuse_transmission.channel), (0.9, Channel::A));
    assert_eq!((s.diffuse_transmission_color.factor, s.dispersion), (Rgb::new(0.5, 0.6, 0.7), 1.5));
}

#[test]
fn glossiness_becomes_roughness() {
    let glossy = standard(
        r#"{"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.1, 0.2, 0.3, 1],
            "specularFactor": [0.4, 0.5, 0.6], "glossinessFactor": 0.75}}}"#,
    );
    assert_eq!((glossy.base_color.factor, glossy.metalness.factor), (Rgb::new(0.1, 0.2, 0.3), 0.0));
    assert_eq!((glossy.specular_color.factor, glossy.roughness.factor), (Rgb::new(0.4, 0.5, 0.6), 0.25));
}

#[test]
fn a_broken_image_is_magenta_and_told_of_once() {
    let json = r#", "nodes": [{"mesh": 0}], "textures": [{"source": 0}], "images": [{"uri": "none.png"}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0}}]"#;
    let bytes = triangle_bytes(json, r#", "material": 0"#);
    let (scene, warnings) = scene_at(bytes, &Moment::default()).expect("a scene");
    assert!(scene.textures.iter().all(|texture| texture.pattern == Pattern::Missing));
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].to_string().contains("images[0]: `none.png`: file not found"), "{}", warnings[0]);
}

#[test]
fn textures_keep_their_samplers_sets_and_transforms() {
    let png = crate::made::everything();
    let (scene, _) = scene_at(png, &Moment::default()).expect("a scene");
    let Pattern::Image { wrap_u, wrap_v, filtering, minify, ref image } = scene.textures[0].pattern else {
        panic!("no image")
    };
    assert_eq!((wrap_u, wrap_v, filtering), (Wrap::Repeat, Wrap::Repeat, Filtering::Bilinear));
    assert_eq!(minify, Minify::Mip);
    assert_eq!((image.width, image.channels, scene.textures[0].uv.set), (1, 4, UvSet::First));
    assert_eq!(scene.materials[0].opacity.channel, Channel::A);
}

#[test]
fn what_moves_has_poses_over_the_shutter() {
    let moment = Moment { seconds: 0.5, shutter: 0.2, ..Moment::default() };
    let (scene, _) = scene_at(crate::made::everything(), &moment).expect("a scene");
    let poses = scene.cameras[0].motion.poses();
    assert_eq!(poses.len(), 2, "a straight way");
    let moved = poses[1].translation - poses[0].translation;
    assert!(moved.distance(DVec3::X) < 1e-6, "5 m/s for 0.2 s: {moved}");
    // The skin follows its bone to the middle of the way; the target adds half of (0, 0, 2) to its first vertex.
    assert_eq!(scene.meshes[0].positions[0], Vec3::new(2.5, 0.0, 1.0));
}

#[test]
fn copies_are_one_group() {
    let (scene, _) = scene_at(crate::made::everything(), &Moment::default()).expect("a scene");
    let places: Vec<_> = scene.groups[0].places.iter().map(|place| place.translation).collect();
    assert_eq!(places, [DVec3::ZERO, 5.0 * DVec3::X]);
}

#[test]
fn variants_change_materials() {
    let json = r#", "nodes": [{"mesh": 0}], "materials": [{"name": "day"}, {"name": "night"}],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "dusk"}, {"name": "dark"}]}}"#;
    let mapped = r#", "material": 0, "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}}"#;
    let named = |variant| {
        let moment = Moment { variant, ..Moment::default() };
        let (scene, _) = scene_at(triangle_bytes(json, mapped), &moment).expect("a scene");
        scene.materials[0].name.clone()
    };
    assert_eq!([named(None), named(Some(0)), named(Some(1))], ["day", "day", "night"]);
}

#[test]
fn single_sided_materials_hide_their_backs_unless_light_comes_through() {
    let hides = |json: &str| material(json).hides_back();
    assert!(hides("{}") && hides(r#"{"alphaMode": "BLEND"}"#) && hides(r#"{"doubleSided": false}"#));
    assert!(!hides(r#"{"doubleSided": true}"#));
    for (name, factor) in
        [("transmission", "transmissionFactor"), ("diffuse_transmission", "diffuseTransmissionFactor")]
    {
        let with = |v: f32| format!(r#"{{"extensions": {{"KHR_materials_{name}": {{"{factor}": {v}}}}}}}"#);
        assert!(hides(&with(0.0)) && !hides(&with(0.5)), "{name}");
    }
    assert!(hides(r#"{"extensions": {"KHR_materials_unlit": {}}}"#));
    // What has no material is single-sided too.
    assert!(triangle(r#", "nodes": [{"mesh": 0}]"#).materials[0].hides_back());
}
