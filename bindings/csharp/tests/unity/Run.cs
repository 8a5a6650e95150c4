// The file has what the sample uses of Unity, and a program that lets the sample run for 200 frames while the mouse
// goes from left to right: Unity itself is not needed to see that the sample compiles, and that the wire stops at the
// block.
using System;
using System.Reflection;

namespace UnityEngine
{
  public struct Vector3
  {
    public float x, y, z;
    public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
  }

  public struct Color
  {
    public static readonly Color red = new Color(), green = new Color();
  }

  public static class Mathf
  {
    public static float Clamp01(float value) { return Math.Min(Math.Max(value, 0), 1); }
  }

  public static class Screen { public static int width = 1000; }
  public static class Time { public static float deltaTime = 0.02f; }
  public static class Input { public static Vector3 mousePosition; }
  public enum PrimitiveType { Cube }
  public sealed class Shader { public static Shader Find(string name) { return new Shader(); } }
  public sealed class Material { public Material(Shader shader) {} }
  public sealed class Transform { public Vector3 position, localScale; }

  public sealed class LineRenderer
  {
    public Material material;
    public float startWidth, endWidth;
    public int positionCount;
    public Color startColor, endColor;
    public void SetPositions(Vector3[] positions) { Program.Drawn = positions; }
  }

  public sealed class GameObject
  {
    public readonly Transform transform = new Transform();
    public static GameObject CreatePrimitive(PrimitiveType type) { return new GameObject(); }
    public T AddComponent<T>() where T : new() { return new T(); }
  }

  public class MonoBehaviour { public readonly GameObject gameObject = new GameObject(); }
}

static class Program
{
  internal static UnityEngine.Vector3[] Drawn;

  private static void Call(object target, string name)
  {
    target.GetType().GetMethod(name, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(target, null);
  }

  private static int Main()
  {
    var sample = new WireInMesh();
    Call(sample, "Start");
    for (int frame = 0; frame < 200; ++frame)
    {
      UnityEngine.Input.mousePosition = new UnityEngine.Vector3(Math.Min(10 * frame, 1000), 0, 0);
      Call(sample, "Update");
    }
    Call(sample, "OnDestroy");
    UnityEngine.Vector3 middle = Drawn[Drawn.Length / 2];
    Console.WriteLine("sample: the wire's middle is at x = " + middle.x);
    return middle.x > 2.9f && middle.x <= 3.0f ? 0 : 1; // the block begins at 3
  }
}
