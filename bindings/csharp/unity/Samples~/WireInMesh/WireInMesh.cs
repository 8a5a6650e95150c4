// A wire follows the mouse in a box of cells and slides along the block that stands in it. The block is drawn as a mesh; the wire, in red
// where it touched something in the last move, as a line.
using Dartsweep;
using UnityEngine;
using Environment = Dartsweep.Environment;

public sealed class WireInMesh : MonoBehaviour
{
  private const int Width = 8;      // cells along each axis, of side 1
  private const int Vertices = 12;  // of the wire
  private const float Speed = 4.0f; // sides of a cell in a second

  private Environment environment;
  private Scene scene;
  private Body wire;
  private MoveOptions slide;
  private LineRenderer line;
  private readonly Vector3[] drawn = new Vector3[Vertices];

  private void Start()
  {
    environment = Box();
    environment.MarkRegion(2, Mark.Impassable);
    scene = new Scene(environment);
    double[] positions = new double[3 * Vertices];
    uint[] edges = new uint[2 * (Vertices - 1)];
    for (int i = 0; i < Vertices; ++i)
    {
      positions[3 * i] = 0.75;
      positions[3 * i + 1] = 1.5 + 0.4 * i;
      positions[3 * i + 2] = 4.3;
    }
    for (int i = 0; i < edges.Length; ++i) edges[i] = (uint)((i + 1) / 2);
    wire = scene.CreateBody(positions, edges);
    slide = new MoveOptions { VertexResponse = Response.Slide, EdgeResponse = Response.Slide };

    line = gameObject.AddComponent<LineRenderer>();
    line.material = new Material(Shader.Find("Sprites/Default"));
    line.startWidth = line.endWidth = 0.08f;
    line.positionCount = Vertices;
    GameObject block = GameObject.CreatePrimitive(PrimitiveType.Cube); // region 2, see Box
    block.transform.position = new Vector3(4, 4, 4);
    block.transform.localScale = new Vector3(2, 4, 2);
  }

  private void Update()
  {
    double[] targets = wire.GetPositions();
    float mouse = Mathf.Clamp01(Input.mousePosition.x / Screen.width) * (Width - 1) + 0.5f;
    double most = Speed * Time.deltaTime;
    double wanted = mouse - targets[0];
    double step = wanted > most ? most : wanted < -most ? -most : wanted;
    for (int i = 0; i < targets.Length; i += 3) targets[i] += step;
    MoveReport report = wire.Move(targets, slide);

    double[] positions = wire.GetPositions();
    for (int i = 0; i < Vertices; ++i)
      drawn[i] = new Vector3((float)positions[3 * i], (float)positions[3 * i + 1], (float)positions[3 * i + 2]);
    line.SetPositions(drawn);
    line.startColor = line.endColor = report.ContactCount > 0 ? Color.red : Color.green;
  }

  private void OnDestroy()
  {
    if (scene != null) scene.Dispose();
    if (environment != null) environment.Dispose();
  }

  // Hexahedra of side 1; the block in the middle, 2 x 4 x 2 of them, is region 2.
  private static Environment Box()
  {
    const int points = Width + 1;
    double[] positions = new double[3 * points * points * points];
    for (int p = 0; p < positions.Length / 3; ++p)
    {
      positions[3 * p] = p % points;
      positions[3 * p + 1] = p / points % points;
      positions[3 * p + 2] = p / (points * points);
    }
    int[] cells = new int[8 * Width * Width * Width], regions = new int[cells.Length / 8];
    int[] corners = { 0, 1, points + 1, points }; // of a square, counter-clockwise
    for (int cell = 0; cell < regions.Length; ++cell)
    {
      int i = cell % Width, j = cell / Width % Width, k = cell / (Width * Width);
      for (int c = 0; c < 8; ++c) cells[8 * cell + c] = ((k + c / 4) * points + j) * points + i + corners[c % 4];
      bool block = i >= 3 && i < 5 && j >= 2 && j < 6 && k >= 3 && k < 5;
      regions[cell] = block ? 2 : 1;
    }
    return new Environment(positions, cells, CellType.Hexahedron, regions);
  }
}
