package dartsweep;

import static org.junit.jupiter.api.Assertions.assertEquals;

import com.google.gson.Gson;
import com.google.gson.reflect.TypeToken;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;

class ScenarioTest {
  @Test
  void allBitsAreThoseOfC() throws IOException {
    String text = Files.readString(Path.of(System.getProperty("scenario")));
    Map<String, List<String>> expected = new Gson().fromJson(text, new TypeToken<LinkedHashMap<String, List<String>>>() {}.getType());
    Map<String, List<String>> result = Scenario.play();
    assertEquals(new ArrayList<>(expected.keySet()), new ArrayList<>(result.keySet()));
    expected.forEach((stage, patterns) -> assertEquals(patterns, result.get(stage), stage));
  }
}
