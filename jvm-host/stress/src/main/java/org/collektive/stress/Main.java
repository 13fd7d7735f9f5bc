package org.collektive.stress;

import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import javax.xml.stream.XMLOutputFactory;
import javax.xml.stream.XMLStreamWriter;
import org.openjdk.jcstress.JCStress;
import org.openjdk.jcstress.Options;
import org.openjdk.jcstress.infra.collectors.DiskReadCollector;
import org.openjdk.jcstress.infra.collectors.InProcessCollector;
import org.openjdk.jcstress.infra.collectors.TestResult;

/** Runs jcstress and reports its results as a JUnit XML file and a final line with the totals. */
public final class Main {
  private Main() {}

  /** Takes the JUnit XML file to write, then the options of jcstress. Exits with code 1 if a test failed or none ran. */
  public static void main(String[] arguments) throws Exception {
    Path report = Path.of(arguments[0]);
    Options options = new Options(List.of(arguments).subList(1, arguments.length).toArray(new String[0]));
    if (!options.parse()) System.exit(2);
    try {
      new JCStress(options).run();
    } catch (AssertionError failed) {
      // jcstress throws this error if a test failed; the results below contain the details.
      System.err.println(failed.getMessage());
    }
    InProcessCollector collector = new InProcessCollector();
    DiskReadCollector file = new DiskReadCollector(options.getResultFile(), collector);
    file.dump();
    file.close();
    System.exit(report(collector.getTestResults(), report, System.out) ? 0 : 1);
  }

  private static boolean report(Collection<TestResult> results, Path report, PrintStream out) throws Exception {
    int failed = 0;
    Files.createDirectories(report.toAbsolutePath().getParent());
    try (var stream = Files.newOutputStream(report)) {
      XMLStreamWriter xml = XMLOutputFactory.newFactory().createXMLStreamWriter(stream, "UTF-8");
      xml.writeStartDocument("UTF-8", "1.0");
      xml.writeStartElement("testsuite");
      xml.writeAttribute("name", "stress");
      for (TestResult result : results) {
        List<String> failures = failures(result);
        if (!failures.isEmpty()) failed++;
        xml.writeStartElement("testcase");
        xml.writeAttribute("classname", result.getName());
        xml.writeAttribute("name", String.valueOf(result.getConfig().jvmArgs));
        if (!failures.isEmpty()) {
          xml.writeStartElement("failure");
          xml.writeAttribute("message", failures.get(0));
          xml.writeCharacters(String.join("\n", failures));
          xml.writeEndElement();
        }
        xml.writeEndElement();
      }
      xml.writeEndElement();
      xml.writeEndDocument();
      xml.close();
    }
    out.println((results.size() - failed) + " passed, " + failed + " failed");
    return failed == 0 && !results.isEmpty();
  }

  /** Returns why a test failed, or an empty list if it passed. A forked JVM that crashed or timed out counts as a failure. */
  private static List<String> failures(TestResult result) {
    if (result.grading().isPassed) return List.of();
    List<String> all = new ArrayList<>(result.grading().failureMessages);
    all.addAll(result.getMessages());
    all.addAll(result.getVmErr());
    if (all.isEmpty()) all.add("ended as " + result.status());
    return all;
  }
}
