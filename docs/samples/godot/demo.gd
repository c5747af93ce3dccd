# Draws what lies beside it, for Godot 3: godot3 --path FOLDER -s demo.gd [SUBJECT PICTURE.png], SUBJECT head or bunny.
extends SceneTree

var frames = 0
var picture = ""

func bytes(name):
	var file = File.new()
	file.open("res://" + name, File.READ)
	return file

func shader(name):
	var result = Shader.new()
	result.code = bytes(name).get_as_text()
	return result

func mesh(name):
	var file = bytes(name + ".mesh")
	var count = file.get_32()
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	var points = PoolVector3Array()
	var normals = PoolVector3Array()
	var tangents = PoolRealArray()
	var places = PoolVector2Array()
	for _vertex in range(count):
		points.append(Vector3(file.get_float(), file.get_float(), file.get_float()))
		normals.append(Vector3(file.get_float(), file.get_float(), file.get_float()))
		for _component in range(4):
			tangents.append(file.get_float())
		places.append(Vector2(file.get_float(), file.get_float()))
	var indices = PoolIntArray()
	for _triangle in range(file.get_32() / 3): # front faces are clockwise here
		var a = file.get_32()
		var b = file.get_32()
		indices.append_array(PoolIntArray([a, file.get_32(), b]))
	arrays[Mesh.ARRAY_VERTEX] = points
	arrays[Mesh.ARRAY_NORMAL] = normals
	arrays[Mesh.ARRAY_TANGENT] = tangents
	arrays[Mesh.ARRAY_TEX_UV] = places
	arrays[Mesh.ARRAY_INDEX] = indices
	var result = ArrayMesh.new()
	result.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return result

func image(name):
	var file = bytes(name)
	var picture_of = Image.new()
	picture_of.load_png_from_buffer(file.get_buffer(file.get_len()))
	picture_of.generate_mipmaps()
	var texture = ImageTexture.new()
	texture.create_from_image(picture_of)
	return texture

func cube(name):
	var file = bytes(name)
	var size = file.get_32()
	var result = CubeMap.new()
	for side in [CubeMap.SIDE_RIGHT, CubeMap.SIDE_LEFT, CubeMap.SIDE_TOP, CubeMap.SIDE_BOTTOM, CubeMap.SIDE_FRONT, CubeMap.SIDE_BACK]:
		var face = Image.new()
		face.create_from_data(size, size, false, Image.FORMAT_RGBA8, file.get_buffer(size * size * 4))
		face.generate_mipmaps()
		result.set_side(side, face)
	return result

func add(parent, shape, material):
	var node = MeshInstance.new()
	node.mesh = shape
	node.material_override = material
	parent.add_child(node)

func skin(parent, subject):
	var material = ShaderMaterial.new()
	material.shader = shader("skin.gdshader")
	material.set_shader_param("skin_map", image(subject + "_color.png"))
	material.set_shader_param("normal_map", image(subject + "_normal.png"))
	add(parent, mesh(subject), material)

func fur(parent, subject):
	var shape = mesh(subject)
	var text = shader("fur.gdshader")
	var map = cube(subject + ".cube")
	for layer in range(32):
		var material = ShaderMaterial.new()
		material.shader = text
		material.set_shader_param("fur_map", map)
		material.set_shader_param("layer", float(layer))
		material.set_shader_param("root_color", Color(0.4, 0.27, 0.19)) # sRGB, as the editor's
		material.set_shader_param("tip_color", Color(0.93, 0.77, 0.6))
		add(parent, shape, material)

func _initialize():
	var arguments = OS.get_cmdline_args()
	var subject = "head"
	for i in range(arguments.size()):
		if arguments[i].ends_with(".png"):
			picture = arguments[i]
			subject = arguments[i - 1]
	var scene = parse_json(bytes(subject + ".json").get_as_text())
	var world = Spatial.new()
	get_root().add_child(world)
	var camera = Camera.new()
	world.add_child(camera)
	camera.look_at_from_position(vector(scene.eye), vector(scene.target), Vector3.UP)
	camera.keep_aspect = Camera.KEEP_WIDTH
	camera.fov = scene.fov
	camera.near = 50
	camera.far = 5000
	var environment = Environment.new()
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color(scene.background[0], scene.background[1], scene.background[2])
	environment.ambient_light_energy = 0
	camera.environment = environment
	var lamp = DirectionalLight.new()
	world.add_child(lamp)
	lamp.look_at_from_position(vector(scene.lamp), vector(scene.target), Vector3.UP)
	lamp.light_energy = scene.light
	if subject == "head":
		skin(world, subject)
	else:
		fur(world, subject)

func vector(numbers):
	return Vector3(numbers[0], numbers[1], numbers[2])

func _idle(_delta):
	frames += 1
	if picture != "" and frames == 4:
		var shown = get_root().get_texture().get_data()
		shown.flip_y()
		shown.save_png(picture)
		quit()
