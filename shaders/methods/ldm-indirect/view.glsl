// The camera's view.

uniform mat4 clip_from_world;
