// The one light of the 3D view, as GLSL, and the size of a pixel, which keeps thin things visible from afar.
import {Color, ShaderMaterial} from 'three';

// Height of a pixel at distance 1 from the camera; set before each picture.
export const pixel = {value: 1e-3};

export const GROW = `
  uniform float pixel;
  // A size in the scene, but never below so many pixels.
  float grow(float size, float pixels, float distance) { return max(size, pixels * pixel * distance); }
`;

// Both sides are lit alike: a wall is seen from outside and from inside, whichever way its triangles turn.
export const LIT = `
  vec3 lit(vec3 colour, vec3 normal, vec3 toEye) {
    vec3 n = dot(normal, toEye) < 0.0 ? -normal : normal;
    vec3 light = normalize(vec3(-0.35, 0.6, 0.72));
    float diffuse = 0.5 + 0.5 * dot(n, light);
    float gloss = pow(max(dot(n, normalize(light + toEye)), 0.0), 40.0);
    return colour * (0.28 + 0.82 * diffuse * diffuse) + vec3(0.22 * gloss);
  }
`;

/** A material with the light above; `vertex` has to set vNormal and vToEye in the camera's space, and gl_Position. */
export function litMaterial(vertex, uniforms, options = {}) {
  return new ShaderMaterial({
    uniforms: {pixel, colour: {value: new Color()}, ...uniforms},
    vertexShader: `${GROW} varying vec3 vNormal; varying vec3 vToEye; ${vertex}`,
    fragmentShader: `
      uniform vec3 colour;
      varying vec3 vNormal;
      varying vec3 vToEye;
      ${LIT}
      void main() {
        gl_FragColor = vec4(lit(colour, normalize(vNormal), normalize(vToEye)), 1.0);
        #include <colorspace_fragment>
      }`,
    ...options,
  });
}
